// Pareto fronts against brute force; times to reach an error against power laws.
#include "sim/study/pareto.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace rend::pareto_test {
namespace {

bool beats(const WorkPrecision& a, const WorkPrecision& b) {
  return a.seconds <= b.seconds && a.error <= b.error && (a.seconds < b.seconds || a.error < b.error);
}

TEST(ParetoFront, is_what_nothing_beats) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    std::uniform_int_distribution<int> few(1, 9); // small integers, so that ties are common
    std::vector<WorkPrecision> runs(static_cast<std::size_t>(trial % 40));
    for (WorkPrecision& run : runs) run = {static_cast<double>(few(random)), static_cast<double>(few(random))};
    std::vector<std::size_t> front = pareto_front(runs), expected;
    for (std::size_t n = 0; n < runs.size(); ++n)
      if (std::none_of(runs.begin(), runs.end(),
                       [&](const WorkPrecision& other) { return beats(other, runs[n]); }))
        expected.push_back(n);
    EXPECT_TRUE(std::is_sorted(front.begin(), front.end(), [&](std::size_t a, std::size_t b) {
      return runs[a].seconds < runs[b].seconds;
    }));
    std::sort(front.begin(), front.end());
    EXPECT_EQ(front, expected);
  }
}

TEST(TimeToReach, lies_on_the_power_law_between_two_runs) {
  std::vector<WorkPrecision> runs; // error 1 / t²
  for (double t : {1.0, 2.0, 5.0, 20.0}) runs.push_back({t, 1 / (t * t)});
  for (double error : {0.5, 0.1, 0.01}) {
    const auto reach = time_to_reach(runs, error);
    ASSERT_TRUE(reach);
    EXPECT_FALSE(reach->at_most);
    EXPECT_NEAR(reach->seconds, 1 / std::sqrt(error), 1e-12 / error);
  }
  EXPECT_TRUE(time_to_reach(runs, 1)->at_most);
  EXPECT_EQ(time_to_reach(runs, 2)->seconds, 1);
  EXPECT_FALSE(time_to_reach(runs, 1e-3));
  EXPECT_FALSE(time_to_reach({}, 1));
  EXPECT_EQ(time_to_reach({{1, 0.1}, {3, 0}}, 0.01)->seconds, 3) << "an error of 0 is on no power law";
}

} // namespace
} // namespace rend::pareto_test
