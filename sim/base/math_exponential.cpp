// exponential, logarithm and power of sim/base/math.h.
#include "sim/base/double_double.h"
#include "sim/base/math.h"

#include <array>
#include <cmath>
#include <limits>

namespace rend {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// ln 2 = ln2_high + ln2_low; a multiple of ln2_high by a whole number below 2²⁰ is exact.
constexpr double ln2_high = 0x1.62e42fee00000p-1, ln2_low = 1.9082149292705877e-10;

constexpr std::array<double, 14> inverse_factorials() {
  std::array<double, 14> out{1};
  double factorial = 1; // 13! is below 2⁵³
  for (int n = 1; n < 14; ++n) out[n] = 1 / (factorial *= n);
  return out;
}
// 1/(2n + 1)
constexpr std::array<double, 13> odd_fractions() {
  std::array<double, 13> out{};
  for (int n = 0; n < 13; ++n) out[n] = 1 / (2.0 * n + 1);
  return out;
}

// e^(x + rest) = 2^k e^r,   |r| ≤ ln 2 / 2, and e^r by its series, whose first neglected term is below 5e-18.
// |rest| is far below |x|, or both are small.
double exponential_of(double x, double rest) {
  constexpr auto factor = inverse_factorials();
  if (std::isnan(x)) return x;
  if (x > 710) return infinity; // the largest number is e^709.78
  if (x < -746) return 0;       // the smallest is e^-745.13
  const double k = std::nearbyint(x * (1 / (ln2_high + ln2_low)));
  const DoubleDouble r = exact_sum(x - k * ln2_high, rest - k * ln2_low);
  double sum = factor[13];
  for (int n = 12; n >= 2; --n) sum = sum * r.high + factor[n];
  const DoubleDouble front = exact_sum(1, r.high);
  const double result = front.high + (front.low + (r.low + r.high * r.high * sum));
  return std::ldexp(result, static_cast<int>(k));
}

// ln x = e ln 2 + ln m, with m in [√½, √2), s = (m − 1)/(m + 1) and ln m = 2s(1 + s²/3 + s⁴/5 + ...).
// x > 0 and finite. The error is below 1e-19 of the result: power() multiplies it by up to 745.
DoubleDouble logarithm_of(double x) {
  constexpr auto fraction = odd_fractions();
  constexpr DoubleDouble third{0.3333333333333333, 1.850371707708594e-17};
  int e = 0;
  double m = std::frexp(x, &e);
  if (m < 0.7071067811865476) {
    m *= 2;
    --e;
  }
  const DoubleDouble s = DoubleDouble{m - 1, 0} / exact_sum(m, 1);
  const DoubleDouble square = s * s;
  double sum = fraction[12];
  for (int n = 11; n >= 2; --n) sum = sum * square.high + fraction[n];
  const double rest = square.high * square.high * sum;
  const DoubleDouble series = DoubleDouble{1, 0} + (square * third + DoubleDouble{rest, 0});
  const DoubleDouble half = s * series;
  return DoubleDouble{e * ln2_high, e * ln2_low} + DoubleDouble{2 * half.high, 2 * half.low};
}

// |x|^y, with x and y not NaN and y ≠ 0.
double power_of_size(double x, double y) {
  const double a = std::abs(x);
  if (a == 1) return 1;
  if (a == 0 || std::isinf(a) || std::isinf(y)) return (a > 1) == (y > 0) ? infinity : 0;
  // Beyond 1e20 the result is 0 or infinite for every other x.
  const double exponent = y > 1e20 ? 1e20 : y < -1e20 ? -1e20 : y;
  const DoubleDouble log = logarithm_of(a);
  const DoubleDouble product = exact_product(exponent, log.high);
  return exponential_of(product.high, product.low + exponent * log.low);
}

} // namespace

double exponential(double x) {
  return exponential_of(x, 0);
}

double logarithm(double x) {
  if (std::isnan(x) || x == infinity) return x;
  if (x == 0) return -infinity;
  return x < 0 ? std::numeric_limits<double>::quiet_NaN() : logarithm_of(x).high;
}

double power(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (std::isnan(x) || std::isnan(y)) return std::numeric_limits<double>::quiet_NaN();
  const bool whole = y == std::floor(y), odd = std::abs(std::fmod(y, 2)) == 1;
  if (x < 0 && !whole && !std::isinf(x)) return std::numeric_limits<double>::quiet_NaN();
  const double size = power_of_size(x, y);
  return std::signbit(x) && odd ? -size : size;
}

} // namespace rend
