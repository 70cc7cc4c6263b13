#include "sim/expression/noise.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace rend::noise_test {
namespace {

using Vector = std::array<double, 3>;

Vector moved(Vector p, int axis, double by) {
  p[axis] += by;
  return p;
}

TEST(Noise, is_in_its_range_wherever_it_is_asked) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-300, 300), sign(-1, 1);
  const auto any = [&] { return std::copysign(std::pow(10, exponent(random)), sign(random)); };
  for (int n = 0; n < 100000; ++n) {
    const double value = noise({any(), any(), any()}, any());
    ASSERT_GE(value, 0);
    ASSERT_LT(value, 1);
  }
  for (const double huge : {-1.7e308, -0x1p63, -0.0, 0.0, 0x1p53, 0x1p63, 1.7e308}) {
    EXPECT_GE(noise({huge, -huge, huge}, huge), 0);
    EXPECT_LT(noise({huge, -huge, huge}, huge), 1);
  }
  EXPECT_EQ(noise({0.0, 0.0, 0.0}, 0.0), noise({-0.0, -0.0, -0.0}, -0.0));
}

TEST(Noise, and_its_gradient_are_continuous_across_cells) {
  // On both sides of a plane of the lattice: the values, and the slopes across the plane (0) and along it.
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> place(-20, 20);
  constexpr double h = 1e-6;
  for (int n = 0; n < 5000; ++n) {
    Vector p = {place(random), place(random), place(random)};
    const int axis = n % 3;
    p[axis] = std::floor(p[axis]);
    const double here = noise(p);
    for (const double side : {-h, h}) {
      ASSERT_NEAR(noise(moved(p, axis, side)), here, 4 * h * h); // 3t² of the cubic
      const int along = (axis + 1) % 3;
      const Vector beside = moved(p, axis, side);
      const double slope = (noise(moved(p, along, h)) - noise(moved(p, along, -h))) / (2 * h);
      const double slope_beside = (noise(moved(beside, along, h)) - noise(moved(beside, along, -h))) / (2 * h);
      ASSERT_NEAR(slope, slope_beside, 1e-8);
    }
  }
}

TEST(Noise, has_no_slope_above_that_of_its_weights) {
  // |∂noise/∂x| ≤ max s' · 1 = 1.5
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(-5, 5);
  for (int n = 0; n < 50000; ++n) {
    const Vector p = {place(random), place(random), place(random)};
    ASSERT_LE(std::abs(noise(moved(p, n % 3, 1e-4)) - noise(p)), 1.5e-4 + 1e-12);
  }
}

TEST(Noise, on_the_lattice_is_uniform_and_uncorrelated) {
  double sum = 0, squares = 0, products = 0, seeds = 0;
  const int side = 40, count = side * side * side;
  for (int n = 0; n < count; ++n) {
    const Vector p = {double(n % side), double(n / side % side), double(n / side / side)};
    const double value = noise(p) - 0.5;
    sum += value;
    squares += value * value;
    products += value * (noise(moved(p, 0, 1)) - 0.5);
    seeds += value * (noise(p, 1) - 0.5);
  }
  const double error = 5 / std::sqrt(double(count)); // 5 standard deviations of a mean, over that of one value
  EXPECT_NEAR(sum / count, 0, error / std::sqrt(12));
  EXPECT_NEAR(squares / count, 1.0 / 12, error * std::sqrt(1.0 / 180));
  EXPECT_NEAR(products / count, 0, error / 12);
  EXPECT_NEAR(seeds / count, 0, error / 12);
}

TEST(Noise, between_corners_is_their_cubic_mean) {
  for (const double t : {0.25, 0.5, 0.9}) {
    const double weight = 3 * t * t - 2 * t * t * t;
    const double low = noise({3, -2, 7}), high = noise({4, -2, 7});
    EXPECT_NEAR(noise({3 + t, -2, 7}), (1 - weight) * low + weight * high, 1e-15);
  }
}

TEST(Noise, gives_the_same_values_for_ever) {
  // Presets depend on it: another value here changes their states.
  EXPECT_EQ(noise({0, 0, 0}), 0.62632984588021323);
  EXPECT_EQ(noise({0.3, -1.7, 42.5}, 7), 0.53282332999824222);
}

} // namespace
} // namespace rend::noise_test
