// Fitted orders, against data of known slope and tables of Student's distribution.
#include "sim/study/order_fit.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace rend::order_fit_test {
namespace {

using testing::ElementsAre;

// 3 h^p times (1 + noise), with step sizes halved.
std::vector<OrderPoint> power_law(double p, int count, double noise, std::mt19937& random) {
  std::normal_distribution<double> normal(0, noise);
  std::vector<OrderPoint> points;
  for (int n = 0; n < count; ++n) {
    const double h = 0.01 * std::pow(0.5, n);
    points.push_back({h, 3 * std::pow(h, p) * std::exp(noise > 0 ? normal(random) : 0), false});
  }
  return points;
}

TEST(StudentT, is_that_of_the_tables) {
  // Abramowitz & Stegun, table 26.10.
  const std::vector<std::pair<int, double>> of_0975{{1, 12.706}, {2, 4.303},  {3, 3.182},  {4, 2.776},
                                                    {5, 2.571},  {10, 2.228}, {30, 2.042}, {120, 1.980}};
  for (const auto& [freedom, t] : of_0975) EXPECT_NEAR(student_t(0.975, freedom), t, 5.1e-4) << freedom;
  EXPECT_NEAR(student_t(0.995, 7), 3.499, 5e-4);
}

TEST(OrderFit, of_an_exact_power_law_is_exact) {
  std::mt19937 random(1);
  for (double p : {0.5, 1.0, 2.0, 4.0}) {
    const auto fit = fit_order(power_law(p, 8, 0, random), {10, 0, 0.3});
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->order, p, 1e-12);
    EXPECT_NEAR(fit->high - fit->low, 0, 1e-6);
    EXPECT_NEAR(fit->constant, 3, 1e-9);
    EXPECT_EQ(fit->used.size(), 8u);
  }
}

TEST(OrderFit, has_an_interval_that_holds_the_true_slope_95_times_in_100) {
  std::mt19937 random(2);
  int held = 0;
  constexpr int trials = 4000;
  for (int n = 0; n < trials; ++n) {
    const auto fit = fit_order(power_law(2, 6, 0.02, random), {10, 0, 1e9});
    ASSERT_TRUE(fit);
    held += fit->low <= 2 && 2 <= fit->high;
  }
  EXPECT_NEAR(static_cast<double>(held) / trials, 0.95, 0.015);
}

TEST(OrderFit, leaves_out_what_failed_what_is_not_small_and_what_is_the_references_own) {
  std::mt19937 random(3);
  std::vector<OrderPoint> points = power_law(2, 8, 0, random);
  points[0].failed = true;
  points[0].error = 0;
  points[1].error = 0.2;
  points[7].error = 1e-9;
  const auto fit = fit_order(points, {0.1, 1e-9, 0.3});
  ASSERT_TRUE(fit);
  EXPECT_THAT(fit->used, ElementsAre(6, 5, 4, 3, 2));
  EXPECT_NEAR(fit->order, 2, 1e-12);
}

TEST(OrderFit, takes_the_straight_part_from_the_smallest_step_up) {
  std::vector<OrderPoint> points; // order 2 up to a kink, from there on 0.5
  for (int n = 0; n < 9; ++n) {
    const double h = 1e-4 * std::pow(2, n);
    points.push_back({h, n <= 4 ? h * h : std::pow(16e-4, 2) * std::pow(2, 0.5 * (n - 4)), false});
  }
  const auto fit = fit_order(points, {1, 0, 0.3});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->order, 2, 1e-12);
  EXPECT_THAT(fit->used, ElementsAre(0, 1, 2, 3, 4));
}

TEST(OrderFit, is_none_of_fewer_than_three_points) {
  EXPECT_FALSE(fit_order({}, {}));
  EXPECT_FALSE(fit_order({{0.1, 0.01, false}, {0.05, 0.0025, false}}, {}));
  EXPECT_FALSE(fit_order({{0.1, 0.01, false}, {0.05, 0.0025, true}, {0.02, 0.0004, false}}, {}));
}

} // namespace
} // namespace rend::order_fit_test
