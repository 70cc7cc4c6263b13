#include "sim/check/bisection.h"

#include "sim/check/watch.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace rend {
namespace {

constexpr long trial_steps = 4000;
constexpr double bracket_digits = 1e-3, widest = 1e4;
// allowed oscillation of the energy: 1/(2ε) at ε below the limit, times a thousand
constexpr double beats = 1e6;

bool stable(const Bench& bench, double step) {
  const Trial trial = bench.open(
      {{"time.step", fmt::format("{}", step)}, {"time.duration", fmt::format("{}", trial_steps * step)}},
      unguarded());
  for (const auto& body : trial->bodies()) shake(*body, 1e-9 * size_of(*body) / step, 11);
  const double start = trial->kinetic_energy();
  double early = 0, late = 0; // sums of kinetic energy
  try {
    for (long n = 0; n < trial_steps; ++n) {
      trial->step();
      if (n % 4 != 0) continue;
      const double now = trial->kinetic_energy();
      if (!(now <= beats * start)) return false;
      if (n >= trial_steps / 4) (n < trial_steps / 2 ? early : late) += now;
    }
  } catch (const Unstable&) {
    return false;
  }
  return late <= 2 * 2 * early; // twice as long
}

} // namespace

double bisected_limit(const Bench& bench, double guess) {
  double low = guess / 1.25, high = guess * 1.25;
  while (!stable(bench, low)) {
    high = low;
    low /= 2;
    if (low * widest < guess) return 0;
  }
  while (stable(bench, high)) {
    low = high;
    high *= 2;
    if (high > guess * widest) return std::numeric_limits<double>::infinity();
  }
  while (high > (1 + bracket_digits) * low) {
    const double middle = std::sqrt(low * high);
    (stable(bench, middle) ? low : high) = middle;
  }
  return low;
}

} // namespace rend
