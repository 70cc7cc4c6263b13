#include "sim/base/math.h"

#include "sim/base/arc_tangent.h"
#include "sim/base/double_double.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace rend {
namespace {

// The series of sin x = x(1 + sum), and of cos x = 1 − x²/2 (1 + sum), |x| ≤ π/4.
double sine_series(double x) {
  const double s = x * x;
  double sum = 0;
  for (int n = 19; n >= 3; n -= 2) sum = (1 + sum) * (-s / (n * (n - 1.0)));
  return sum;
}
double cosine_series(double x) {
  const double s = x * x;
  double sum = 0;
  for (int n = 20; n >= 4; n -= 2) sum = (1 + sum) * (-s / (n * (n - 1.0)));
  return sum;
}

// sin and cos of an angle in [−45, 45] degrees.
double small_sine(double degrees) {
  const double x = degrees * (pi / 180);
  return x * (1 + sine_series(x));
}
double small_cosine(double degrees) {
  const double x = degrees * (pi / 180);
  return 1 + (1 + cosine_series(x)) * (-(x * x) / 2);
}

// The sine of angle + 90 · quarters degrees. The quarters are counted, as adding them to the angle would round
// it.
double sine_of_turned(double angle, int quarters) {
  const double turn = std::remainder(angle, 360.0); // exact
  const double quadrant = std::nearbyint(turn / 90);
  const double rest = turn - 90 * quadrant;
  switch ((static_cast<int>(quadrant) + quarters) & 3) {
  case 0:
    return small_sine(rest);
  case 1:
    return small_cosine(rest);
  case 2:
    return -small_sine(rest);
  default:
    return -small_cosine(rest);
  }
}

// 64 zeros, then the first 1216 binary digits of 2/π: enough for the largest double.
constexpr std::uint64_t two_over_pi[20] = {0,
                                           0xa2f9836e4e441529,
                                           0xfc2757d1f534ddc0,
                                           0xdb6295993c439041,
                                           0xfe5163abdebbc561,
                                           0xb7246e3a424dd2e0,
                                           0x06492eea09d1921c,
                                           0xfe1deb1cb129a73e,
                                           0xe88235f52ebb4484,
                                           0xe99c7026b45f7e41,
                                           0x3991d639835339f4,
                                           0x9c845f8bbdf9283b,
                                           0x1ff897ffde05980f,
                                           0xef2f118b5a0a6d1f,
                                           0x6d367ecf27cb09b7,
                                           0x4f463f669e5fea2d,
                                           0x7527bac7ebe5f17b,
                                           0x3d0739f78a5292ea,
                                           0x6bfb5fb11f8d5d08,
                                           0x56033046fc7b6bab};

__extension__ typedef unsigned __int128 Wide;

struct Turned {
  int quarters;      // of a turn, modulo 4
  DoubleDouble rest; // [rad], in [−π/4, π/4]
};

// x = quarters · π/2 + rest, modulo 2π, for a finite |x| > π/4. M. H. Payne, R. N. Hanek, Radian reduction for
// trigonometric functions, SIGNUM Newsletter 18, 1983: with x = m 2^e and m whole, those digits of 2/π are left
// out whose product with m 2^e is a multiple of 4. Of the product, 192 bits remain: 2 of quarters, 190 behind
// the point. No double is closer to a multiple of π/2 than 2^-61, so 129 of those bits count in the worst case.
Turned turned_of(double x) {
  int exponent = 0;
  const auto m = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(x), &exponent), 53));
  const int first = exponent - 53 + 62; // of the digits in the table that count
  const auto digits = [&](int n) {
    const int word = first / 64 + n, shift = first % 64;
    return shift == 0 ? two_over_pi[word] : two_over_pi[word] << shift | two_over_pi[word + 1] >> (64 - shift);
  };
  const Wide low = Wide(m) * digits(2), middle = Wide(m) * digits(1) + (low >> 64);
  const auto top = static_cast<std::uint64_t>(Wide(m) * digits(0) + (middle >> 64));
  const auto next = static_cast<std::uint64_t>(middle);
  int quarters = static_cast<int>(top >> 62);
  Wide fraction = Wide(top << 2 | next >> 62) << 64 | (next << 2 | static_cast<std::uint64_t>(low) >> 62);
  const bool above_half = (fraction >> 127) != 0;
  if (above_half) {
    fraction = -fraction; // 1 − fraction
    ++quarters;
  }
  const auto part = [&](int n) { // 32 bits: exact
    const auto bits = static_cast<std::uint32_t>(fraction >> (96 - 32 * n));
    return std::ldexp(static_cast<double>(bits), -32 * (n + 1));
  };
  const DoubleDouble quarter{1.5707963267948966, 6.123233995736766e-17}; // π/2
  const DoubleDouble rest = (exact_sum(part(0), part(1)) + exact_sum(part(2), part(3))) * quarter;
  if (above_half == (x > 0)) return {x > 0 ? quarters : -quarters, {-rest.high, -rest.low}};
  return {x > 0 ? quarters : -quarters, rest};
}

Turned turned(double x) {
  return std::abs(x) <= pi / 4 ? Turned{0, {x, 0}} : turned_of(x);
}

double sine_of_sum(double x, double low) {
  return x == 0 ? x : x + (x * sine_series(x) + low); // keeps −0
}
double cosine_of_sum(double x, double low) {
  const double half = x * x / 2;
  const DoubleDouble front = ordered_sum(1, -half); // the largest rounding error would be that of 1 − x²/2
  return front.high + (front.low - (half * cosine_series(x) + x * low));
}

// The sine of an angle plus so many quarters of a turn.
double sine_of(const Turned& angle, int quarters) {
  const auto [x, low] = angle.rest;
  const int quarter = (angle.quarters + quarters) & 3;
  const double size = quarter % 2 == 0 ? sine_of_sum(x, low) : cosine_of_sum(x, low);
  return quarter < 2 ? size : -size;
}

} // namespace

double sine(double x) {
  return std::isfinite(x) ? sine_of(turned(x), 0) : std::numeric_limits<double>::quiet_NaN();
}
double cosine(double x) {
  return std::isfinite(x) ? sine_of(turned(x), 1) : std::numeric_limits<double>::quiet_NaN();
}
double tangent(double x) {
  if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
  const Turned angle = turned(x);
  return sine_of(angle, 0) / sine_of(angle, 1);
}

double arc_tangent(double y, double x) {
  return arc_tangent_of(y, x);
}

double sine_of_degrees(double angle) {
  return sine_of_turned(angle, 0);
}
double cosine_of_degrees(double angle) {
  return sine_of_turned(angle, 1);
}

} // namespace rend
