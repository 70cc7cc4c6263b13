#include "sim/study/comparison.h"

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

// How many steps take so long: both are warm after it, and have made as many.
long steps_for(const std::function<void()>& off, const std::function<void()>& on, double seconds) {
  long steps = 1;
  for (;; steps *= 2) {
    const double slower = std::max(seconds_a_step(off, steps), seconds_a_step(on, steps));
    if (slower * static_cast<double>(steps) >= seconds / 2) return steps;
  }
}

} // namespace

Comparison compare_times(const std::function<void()>& off, const std::function<void()>& on, int pairs,
                         double seconds) {
  CHECK(pairs >= 1);
  Comparison result;
  result.pairs = pairs;
  result.steps = steps_for(off, on, seconds);
  std::vector<double> without, with, ratios;
  for (int n = 0; n < pairs; ++n) {
    const bool first = n % 2 == 0;
    const double a = seconds_a_step(first ? off : on, result.steps),
                 b = seconds_a_step(first ? on : off, result.steps);
    without.push_back(first ? a : b);
    with.push_back(first ? b : a);
    ratios.push_back(with.back() / without.back());
  }
  result.off = summary_of(without);
  result.on = summary_of(with);
  std::sort(ratios.begin(), ratios.end());
  const auto at = [&](double share) {
    return ratios[static_cast<std::size_t>(share * static_cast<double>(pairs - 1) + 0.5)];
  };
  result.ratio = summary_of(ratios).median;
  result.low = at(0.25);
  result.high = at(0.75);
  result.noise = 2 * 1.25 * 0.74 * (result.high - result.low) / std::sqrt(static_cast<double>(pairs));
  return result;
}

} // namespace rend
