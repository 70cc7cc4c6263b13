// The steps at which a scheme is run.
//
// The duration is sampled at `study_samples` times after the start, and steps must end there: a run has a
// multiple of study_samples steps, or a smaller power of two, whose step ends are among the samples.
//
//   explicit   from the largest stable step downwards over two decades; before them two steps above it (about
//              1.3 and 2 times), to show failure
//   solving    implicit ones: from a quarter of the duration downwards, over two and a half decades
//   adaptive   tolerances 1e-2 ... 1e-9
//
// A scheme that has no stable step without viscosity (explicit Euler, midpoint) starts at half of symplectic's
// limit if its own limit is below a quarter of that: short runs end before the instability has grown.
#pragma once

#include "sim/scene/scene.h"

#include <vector>

namespace rend {

constexpr long study_samples = 16;

// The parameter by which a scheme is varied.
struct Knob {
  long steps = 0;                  // over the duration
  std::optional<double> tolerance; // of adaptive schemes
};

struct SweepOptions {
  double duration = 0; // [s]
  int steps = 8;
  bool above_limit = true;
};

// By decreasing step or tolerance. `scene` is any scene of the preset: only its limits are used.
std::vector<Knob> sweep_of(const Scheme& scheme, const Scene& scene, const SweepOptions& options);

// The smallest number of steps, none longer than `step` [s], that meets the samples.
long steps_within(double duration, double step);

// The largest step at which explicit schemes resolve the scene: symplectic's limit, or a sixteenth of the
// duration.
double natural_step(const Scene& scene, double duration);

} // namespace rend
