#include "sim/study/sweep.h"

#include "sim/base/check.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr double decades = 2;
constexpr double loosest = -2, tightest = -9; // powers of ten: tolerances

// The nearest number of steps that meets the samples.
long meeting(double steps) {
  if (steps >= study_samples) return study_samples * std::lround(steps / static_cast<double>(study_samples));
  long power = 1;
  while (static_cast<double>(power) < 0.75 * steps) power *= 2;
  return power;
}

// `first` steps, and increasing numbers over `over` decades, without duplicates.
std::vector<long> spread(long first, int count, double over) {
  std::vector<long> all;
  const double last = static_cast<double>(first) * std::pow(10, over);
  for (int n = 0; n < count; ++n) {
    const double share = count > 1 ? static_cast<double>(n) / (count - 1) : 0;
    long steps = meeting(static_cast<double>(first) * std::pow(10, over * share));
    if (n + 1 == count)
      while (static_cast<double>(steps) < last * (1 - 1e-12))
        steps += study_samples; // to cover the decades fully
    if (all.empty() || steps > all.back()) all.push_back(steps);
  }
  return all;
}

std::vector<Knob> of_steps(const std::vector<long>& all) {
  std::vector<Knob> knobs;
  for (long steps : all) knobs.push_back({steps, {}});
  return knobs;
}

bool may_tear(const Scene& scene) {
  return std::any_of(scene.bodies().begin(), scene.bodies().end(),
                     [](const auto& body) { return body->tears(); });
}

// Fracture laws are applied only at the ends of steps: if something can tear, they must not be far apart.
std::vector<Knob> of_tolerances(const Scene& scene, const SweepOptions& options) {
  const double duration = options.duration;
  const long steps = may_tear(scene) ? steps_within(duration, natural_step(scene, duration)) : study_samples;
  std::vector<Knob> knobs;
  for (int n = 0; n < options.steps; ++n) {
    const double share = options.steps > 1 ? static_cast<double>(n) / (options.steps - 1) : 0;
    knobs.push_back({steps, std::pow(10, loosest + share * (tightest - loosest))});
  }
  return knobs;
}

double start_of(const Scheme& scheme, const Scene& scene, double duration) {
  const double own = scene.stability_limit(scheme), natural = natural_step(scene, duration);
  if (std::isinf(own)) return natural;
  return own >= 0.25 * natural ? std::min(own, duration / study_samples) : 0.5 * natural;
}

} // namespace

long steps_within(double duration, double step) {
  CHECK(duration > 0 && step > 0);
  const double least = duration / step * (1 - 1e-12);
  if (least > study_samples) return study_samples * static_cast<long>(std::ceil(least / study_samples));
  long power = 1;
  while (static_cast<double>(power) < least) power *= 2;
  return power;
}

double natural_step(const Scene& scene, double duration) {
  return std::min(scene.stability_limit(*find_scheme("symplectic")), duration / study_samples);
}

std::vector<Knob> sweep_of(const Scheme& scheme, const Scene& scene, const SweepOptions& options) {
  if (scheme.adaptive) return of_tolerances(scene, options);
  if (scheme.solves) return of_steps(spread(4, options.steps + 2, decades + 0.5));
  const long first = steps_within(options.duration, start_of(scheme, scene, options.duration));
  std::vector<Knob> knobs = of_steps(spread(first, options.steps, decades));
  if (!options.above_limit || first < 2 * study_samples) return knobs;
  const auto part = [&](double share) { return meeting(static_cast<double>(first) * share); };
  if (part(0.75) < first) knobs.insert(knobs.begin(), {part(0.75), {}});
  if (part(0.5) < knobs.front().steps) knobs.insert(knobs.begin(), {part(0.5), {}});
  return knobs;
}

} // namespace rend
