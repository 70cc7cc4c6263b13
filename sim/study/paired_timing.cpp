#include "sim/study/paired_timing.h"

#include "sim/base/check.h"
#include "sim/study/runs.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

double seconds_a_step(const std::function<void()>& step, long steps) {
  const double start = thread_seconds();
  for (long n = 0; n < steps; ++n) step();
  return (thread_seconds() - start) / static_cast<double>(steps);
}

// The number of steps that take so long; afterwards both are warmed up by the same number of steps.
long steps_for(const std::function<void()>& off, const std::function<void()>& on, double seconds) {
  long steps = 1;
  for (;; steps *= 2) {
    const double slower = std::max(seconds_a_step(off, steps), seconds_a_step(on, steps));
    if (slower * static_cast<double>(steps) >= seconds / 2) return steps;
  }
}

// Interpolated between order statistics, as in summary_of().
double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

} // namespace

TimedPairs time_pairs(const std::function<void()>& off, const std::function<void()>& on, int pairs,
                      double seconds) {
  CHECK(pairs >= 1);
  TimedPairs times;
  times.steps = steps_for(off, on, seconds);
  for (int n = 0; n < pairs; ++n) {
    if (n % 2 == 0) times.off.push_back(seconds_a_step(off, times.steps));
    times.on.push_back(seconds_a_step(on, times.steps));
    if (n % 2 != 0) times.off.push_back(seconds_a_step(off, times.steps));
  }
  return times;
}

Comparison comparison_of(const std::vector<TimedPairs>& builds) {
  CHECK(!builds.empty());
  std::vector<double> off, on, ratios, medians;
  for (const TimedPairs& build : builds) {
    std::vector<double> own;
    for (std::size_t n = 0; n < build.off.size(); ++n) own.push_back(build.on[n] / build.off[n]);
    medians.push_back(quantile(own, 0.5));
    ratios.insert(ratios.end(), own.begin(), own.end());
    off.insert(off.end(), build.off.begin(), build.off.end());
    on.insert(on.end(), build.on.begin(), build.on.end());
  }
  Comparison result;
  result.off = summary_of(off);
  result.on = summary_of(on);
  result.ratio = quantile(medians, 0.5);
  result.low = quantile(ratios, 0.25);
  result.high = quantile(ratios, 0.75);
  result.builds = static_cast<int>(builds.size());
  result.noise = 2 * 1.25 * 0.74 * (quantile(medians, 0.75) - quantile(medians, 0.25)) /
                 std::sqrt(static_cast<double>(builds.size()));
  return result;
}

} // namespace rend
