// exponential, logarithm, power, and sines of angles in radians, against the C library in 80 bits.
#include "sim/base/double_double.h"
#include "sim/base/math.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace rend::math_exponential_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// The error in units in the last place of the result.
double ulps(double found, long double expected) {
  const double rounded = static_cast<double>(expected);
  if (found == rounded || (std::isnan(found) && std::isnan(rounded))) return 0;
  if (!std::isfinite(found) || !std::isfinite(rounded)) return infinity;
  const double size = std::abs(rounded);
  const long double unit = std::nextafter(size, infinity) - size;
  return static_cast<double>(std::abs(found - expected) / unit);
}

// Finite, of any exponent and sign.
double any_double(std::mt19937_64& random) {
  for (;;) {
    const double x = std::bit_cast<double>(std::uint64_t{random()});
    if (std::isfinite(x)) return x;
  }
}

TEST(Exponential, agrees_with_the_library_to_one_unit_in_the_last_place) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> wide(-745, 709.7), narrow(-1, 1);
  for (int n = 0; n < 300000; ++n)
    for (const double x : {wide(random), narrow(random), narrow(random) * 1e-9, any_double(random)})
      ASSERT_LT(ulps(exponential(x), std::exp(static_cast<long double>(x))), 1) << x;
}

TEST(Logarithm, agrees_with_the_library_to_one_unit_in_the_last_place) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> narrow(0.5, 1.5);
  for (int n = 0; n < 300000; ++n)
    for (const double x : {std::abs(any_double(random)), narrow(random), 1 + 1e-9 * narrow(random)})
      ASSERT_LT(ulps(logarithm(x), std::log(static_cast<long double>(x))), 1) << x;
}

TEST(Power, agrees_with_the_library_to_one_unit_in_the_last_place) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> base(0, 4), exponent(-40, 40), all(-700, 700), near(0.99999, 1.00001);
  for (int n = 0; n < 300000; ++n) {
    const double x = std::abs(any_double(random));
    for (const auto& [a, b] : {std::pair{base(random), exponent(random)},
                               {x, all(random) / std::log(x)},
                               {near(random), 1e5 * all(random)},
                               {any_double(random), any_double(random)}})
      ASSERT_LT(ulps(power(a, b), std::pow(static_cast<long double>(a), static_cast<long double>(b))), 1)
          << a << " ^ " << b;
  }
}

TEST(Power, of_whole_numbers_is_exact) {
  for (int base = -40; base <= 40; ++base) {
    double expected = 1;
    for (int n = 0; n <= 100 && std::abs(expected) <= 0x1p53; ++n, expected *= base)
      EXPECT_EQ(power(base, n), expected) << base << "^" << n;
  }
  for (int n = -1074; n < 1024; ++n) EXPECT_EQ(power(2, n), std::ldexp(1, n));
  for (int n = 1; n < 100000; ++n) {
    ASSERT_EQ(power(1.0 * n * n, 0.5), n);
    ASSERT_EQ(power(n + 0.125, 2), (n + 0.125) * (n + 0.125));
  }
}

TEST(Power, has_the_limits_of_the_library) {
  const double all[] = {0.0,     -0.0,   1,       -1,       2,         -2,          3,      -3,
                        0.5,     -0.5,   2.5,     1e20,     1e21,      1e300,       -1e300, 1e-300,
                        -1e-300, 5e-324, -5e-324, infinity, -infinity, not_a_number};
  for (const double x : all) {
    for (const double y : all) {
      const double found = power(x, y), expected = std::pow(x, y);
      if (std::isnan(expected))
        EXPECT_TRUE(std::isnan(found)) << x << " ^ " << y;
      else if (std::isinf(expected) || expected == 0) {
        EXPECT_EQ(found, expected) << x << " ^ " << y;
        EXPECT_EQ(std::signbit(found), std::signbit(expected)) << x << " ^ " << y;
      } else
        EXPECT_DOUBLE_EQ(found, expected) << x << " ^ " << y;
    }
    EXPECT_EQ(ulps(exponential(x), std::exp(x)) < 2, true) << x;
    EXPECT_EQ(ulps(logarithm(x), std::log(x)) < 2, true) << x;
  }
}

TEST(Sine, of_radians_agrees_with_the_library_to_one_unit_in_the_last_place) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> turn(-7, 7), many(-1e6, 1e6);
  for (int n = 0; n < 200000; ++n) {
    const double beside = std::nextafter(n * (pi / 2), n % 3 == 0 ? 0 : 1e9); // near a multiple of π/2
    for (const double x : {turn(random), many(random), beside, -beside, any_double(random)}) {
      const auto exact = static_cast<long double>(x);
      ASSERT_LT(ulps(sine(x), std::sin(exact)), 1) << x;
      ASSERT_LT(ulps(cosine(x), std::cos(exact)), 1) << x;
      ASSERT_LT(ulps(tangent(x), std::tan(exact)), 3) << x;
    }
  }
}

TEST(Sine, of_the_double_closest_to_a_quarter_of_a_turn_is_precise) {
  // J.-M. Muller, Elementary Functions, 11.3.2: no double is closer to a multiple of π/2.
  const double closest = std::ldexp(6381956970095103.0, 797);
  EXPECT_NEAR(cosine(closest), -4.68716592425462761112e-19, 1e-34);
  EXPECT_EQ(std::abs(sine(closest)), 1);
}

TEST(Sine, keeps_signs_and_refuses_what_is_not_finite) {
  EXPECT_TRUE(std::signbit(sine(-0.0)));
  EXPECT_EQ(cosine(0), 1);
  for (const double x : {infinity, -infinity, not_a_number}) {
    EXPECT_TRUE(std::isnan(sine(x)));
    EXPECT_TRUE(std::isnan(cosine(x)));
    EXPECT_TRUE(std::isnan(tangent(x)));
  }
}

TEST(DoubleDouble, sums_and_products_of_doubles_are_exact) {
  std::mt19937_64 random(5);
  std::uniform_int_distribution<std::int64_t> whole(-(1LL << 53), 1LL << 53);
  for (int n = 0; n < 100000; ++n) {
    const std::int64_t a = whole(random), b = whole(random);
    const DoubleDouble sum = exact_sum(static_cast<double>(a), static_cast<double>(b));
    ASSERT_EQ(static_cast<std::int64_t>(sum.high) + static_cast<std::int64_t>(sum.low), a + b);
    const DoubleDouble product = exact_product(static_cast<double>(a), static_cast<double>(b));
    __extension__ typedef __int128 Wide;
    ASSERT_TRUE(static_cast<Wide>(product.high) + static_cast<Wide>(product.low) == Wide(a) * b)
        << a << " " << b;
  }
}

} // namespace
} // namespace rend::math_exponential_test
