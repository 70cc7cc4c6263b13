#include "sim/base/math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace rend::math_test {
namespace {

TEST(ArcTangent, agrees_with_the_library_for_all_directions) {
  for (int n = -200000; n <= 200000; ++n) {
    const double angle = n * (pi / 200000), y = std::sin(angle), x = std::cos(angle);
    ASSERT_NEAR(arc_tangent(y, x), std::atan2(y, x), 4e-16 * std::max(1.0, std::abs(angle))) << angle;
  }
}

TEST(ArcTangent, agrees_with_the_library_to_relative_precision_at_any_scale) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-150, 150), sign(-1, 1);
  for (int n = 0; n < 200000; ++n) {
    const double y = std::copysign(std::pow(10, exponent(random)), sign(random));
    const double x = std::copysign(std::pow(10, exponent(random)), sign(random));
    const double expected = std::atan2(y, x);
    ASSERT_NEAR(arc_tangent(y, x), expected, 4e-16 * std::abs(expected)) << y << " " << x;
  }
}

TEST(ArcTangent, is_precise_between_its_table_entries) {
  for (int n = 0; n <= 100000; ++n) {
    const double t = n / 100000.0;
    ASSERT_NEAR(arc_tangent(t, 1), std::atan(t), 1.2e-16) << t; // one unit in the last place of the table's
  }
}

TEST(ArcTangent, is_exact_along_the_axes) {
  EXPECT_EQ(arc_tangent(0, 0), 0);
  EXPECT_EQ(arc_tangent(0, 1), 0);
  EXPECT_EQ(arc_tangent(0, -1), pi);
  EXPECT_EQ(arc_tangent(-0.0, -1), pi); // in (−π, π]
  EXPECT_EQ(arc_tangent(1, 0), pi / 2);
  EXPECT_EQ(arc_tangent(-1, 0), -pi / 2);
  EXPECT_EQ(arc_tangent(1, 1), std::atan(1.0));
}

TEST(ArcTangent, is_odd_in_y) {
  for (int n = 1; n < 1000; ++n) EXPECT_EQ(arc_tangent(-n, 357), -arc_tangent(n, 357));
}

TEST(SineAndCosine, agree_with_the_library_for_all_angles) {
  for (int n = -80000; n <= 80000; ++n) {
    const double degrees = n / 100.0;
    const long double radians =
        static_cast<long double>(degrees) * 3.14159265358979323846264338327950288L / 180;
    ASSERT_NEAR(sine_of_degrees(degrees), static_cast<double>(std::sin(radians)), 4e-16) << degrees;
    ASSERT_NEAR(cosine_of_degrees(degrees), static_cast<double>(std::cos(radians)), 4e-16) << degrees;
  }
}

TEST(SineAndCosine, are_exact_at_multiples_of_ninety_degrees) {
  const double sine[] = {0, 1, 0, -1};
  for (int quarter = -4000; quarter <= 4000; ++quarter) {
    EXPECT_EQ(sine_of_degrees(90.0 * quarter), sine[(quarter % 4 + 4) % 4]) << quarter;
    EXPECT_EQ(cosine_of_degrees(90.0 * quarter), sine[(quarter % 4 + 5) % 4]) << quarter;
  }
}

TEST(SineAndCosine, of_the_same_angle_are_a_unit_vector) {
  for (int n = 0; n < 36000; ++n) {
    const double s = sine_of_degrees(n / 100.0), c = cosine_of_degrees(n / 100.0);
    ASSERT_NEAR(s * s + c * c, 1, 1e-15);
  }
}

} // namespace
} // namespace rend::math_test
