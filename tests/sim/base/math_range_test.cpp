// Angles of many turns and tiny ones, where a range reduction with rounding errors would show.
#include "sim/base/math.h"

#include <cmath>
#include <gtest/gtest.h>

namespace rend::math_range_test {
namespace {

constexpr long double exact_pi = 3.14159265358979323846264338327950288L;

long double turns_removed(double degrees) { // exact
  return std::remainder(static_cast<long double>(degrees), 360.0L) * exact_pi / 180;
}

TEST(SineAndCosine, agree_with_the_library_for_huge_and_tiny_angles) {
  for (const double size :
       {1e-300, 1e-20, 1e-9, 89.99999999999999, 1e9 + 0.3, 1e15 + 0.5, 1e17, 123456789e12, 1e300}) {
    for (const double angle : {size, -size}) {
      EXPECT_NEAR(sine_of_degrees(angle), static_cast<double>(std::sin(turns_removed(angle))), 2e-16) << angle;
      EXPECT_NEAR(cosine_of_degrees(angle), static_cast<double>(std::cos(turns_removed(angle))), 2e-16)
          << angle;
    }
  }
}

TEST(SineAndCosine, are_exact_at_multiples_of_ninety_degrees_after_many_turns) {
  for (const double turns : {1e3, -1e3, 1e12, -1e12, 1e13}) {
    const double start = 360 * turns;
    const double sines[5] = {0, 1, 0, -1, 0};
    for (int n = 0; n < 4; ++n) {
      EXPECT_EQ(sine_of_degrees(start + 90 * n), sines[n]) << turns;
      EXPECT_EQ(cosine_of_degrees(start + 90 * n), sines[n + 1]) << turns;
    }
  }
}

TEST(ArcTangent, has_no_step_where_its_table_changes) {
  for (int eighth = 0; eighth <= 8; ++eighth) {
    double below = eighth / 8.0, above = below;
    for (int n = 0; n < 20; ++n) {
      for (const double t : {below, above})
        for (const auto& [y, x] : {std::pair{t, 1.0}, {1.0, t}, {-1.0, -t}, {t + 1e-30, -1.0}})
          EXPECT_NEAR(arc_tangent(y, x), static_cast<double>(std::atan2(static_cast<long double>(y), x)),
                      4.5e-16);
      below = std::nextafter(below, 0.0);
      above = std::nextafter(above, 2.0);
    }
  }
}

} // namespace
} // namespace rend::math_range_test
