// The SIMD arc tangent of four doubles against the scalar one, bit for bit.
#include "sim/base/arc_tangent.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace rend::arc_tangent_test {
namespace {

REND_INLINE void in_lanes(const double* y, const double* x, double* angle, std::size_t count) {
  for (std::size_t n = 0; n < count; n += 4) {
    Double4 ys, xs;
    __builtin_memcpy(&ys, y + n, sizeof ys);
    __builtin_memcpy(&xs, x + n, sizeof xs);
    const Double4 angles = arc_tangent_of(ys, xs);
    __builtin_memcpy(angle + n, &angles, sizeof angles);
  }
}

void expect_same_bits(std::vector<double> y, std::vector<double> x) {
  y.resize((y.size() + 3) / 4 * 4);
  x.resize(y.size());
  std::vector<double> angle(y.size());
  at_width<in_lanes>(y.data(), x.data(), angle.data(), y.size());
  for (std::size_t n = 0; n < y.size(); ++n) {
    const double one = arc_tangent(y[n], x[n]);
    if (std::isnan(one))
      ASSERT_TRUE(std::isnan(angle[n])) << y[n] << " " << x[n];
    else
      ASSERT_EQ(std::bit_cast<std::uint64_t>(angle[n]), std::bit_cast<std::uint64_t>(one))
          << y[n] << " " << x[n];
  }
}

TEST(ArcTangentOfFour, has_the_bits_of_one_in_all_directions) {
  std::vector<double> y, x;
  for (int n = -100000; n <= 100000; ++n) {
    y.push_back(std::sin(n * (pi / 100000)));
    x.push_back(std::cos(n * (pi / 100000)));
  }
  expect_same_bits(y, x);
}

TEST(ArcTangentOfFour, has_the_bits_of_one_where_the_table_changes) {
  std::vector<double> y, x;
  for (int eighth = 0; eighth <= 8; ++eighth)
    for (const double t : {std::nextafter(eighth / 8.0, -1.0), eighth / 8.0, std::nextafter(eighth / 8.0, 2.0)})
      for (const double sy : {-1.0, 1.0})
        for (const double sx : {-1.0, 1.0}) {
          y.insert(y.end(), {sy * t, sy});
          x.insert(x.end(), {sx, sx * t});
        }
  expect_same_bits(y, x);
}

TEST(ArcTangentOfFour, has_the_bits_of_one_at_any_scale_and_beyond) {
  std::mt19937_64 random(2);
  const std::vector<double> odd{0.0, 5e-324, 1e-310, 1e-300, 1, 1e300, 1.7e308, INFINITY, NAN};
  std::vector<double> y, x;
  for (const double a : odd)
    for (const double b : odd)
      for (int signs = 0; signs < 4; ++signs) {
        y.push_back(signs & 1 ? -a : a);
        x.push_back(signs & 2 ? -b : b);
      }
  for (int n = 0; n < 100000; ++n) { // random bit patterns
    y.push_back(std::bit_cast<double>(random()));
    x.push_back(std::bit_cast<double>(random()));
  }
  expect_same_bits(y, x);
}

TEST(ArcTangent, is_zero_at_the_origin_and_not_a_number_without_end) {
  for (const double y : {0.0, -0.0})
    for (const double x : {0.0, -0.0}) EXPECT_EQ(std::bit_cast<std::uint64_t>(arc_tangent(y, x)), 0u);
  constexpr double infinity = std::numeric_limits<double>::infinity(),
                   none = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {infinity, -infinity, none})
    for (const double other : {0.0, 1.0, -1.0, infinity, none}) {
      EXPECT_TRUE(std::isnan(arc_tangent(bad, other)));
      EXPECT_TRUE(std::isnan(arc_tangent(other, bad)));
    }
}

} // namespace
} // namespace rend::arc_tangent_test
