#include "sim/check/bisection.h"

#include "sim/check/watch.h"

#include <fmt/format.h>

#include <cmath>

namespace rend {
namespace {

constexpr long steps = 4000, looked_at = 50;
constexpr double growth = 1e6, digits = 5e-4;

bool stable(const Bench& bench, double step) {
  const Trial trial =
      bench.open({{"time.step", fmt::format("{}", step)}, {"time.duration", fmt::format("{}", steps * step)}});
  for (const auto& body : trial->bodies()) shake(*body, 1e-9 * size_of(*body) / step, 11);
  const double start = trial->kinetic_energy();
  try {
    for (long n = 0; n < steps; ++n) {
      trial->step();
      if (n % looked_at == 0 && !(trial->kinetic_energy() <= growth * start)) return false;
    }
  } catch (const Unstable&) {
    return false;
  }
  return true;
}

} // namespace

double bisected_limit(const Bench& bench, double omega) {
  double high = 0.01 / omega;
  while (high * omega < 20 && stable(bench, high)) high *= 1.3;
  double low = high / 1.3;
  while (high > (1 + digits) * low) {
    const double middle = std::sqrt(low * high);
    (stable(bench, middle) ? low : high) = middle;
  }
  return low;
}

} // namespace rend
