// Which steps a scheme is run at.
//
// The stretch is sampled at `study_samples` moments after the start, and every step must divide it so that
// steps end there: a run has a multiple of study_samples steps, or a smaller power of two, which meets every so
// many of them.
//
//   explicit   from the largest stable step downwards over two decades; before them two steps above it (about
//              1.3 and 2 times), so that failure shows
//   solving    from a quarter of the stretch downwards, over two and a half decades
//   adaptive   tolerances 1e-2 ... 1e-9
//
// A scheme that has no stable step without viscosity (explicit Euler, midpoint) starts at half of what
// symplectic may take where its own limit is below a quarter of that: short stretches end before it has grown.
#pragma once

#include "sim/scene/scene.h"

#include <vector>

namespace rend {

constexpr long study_samples = 16;

// What a scheme is varied by.
struct Knob {
  long steps = 0;                  // of the stretch
  std::optional<double> tolerance; // of adaptive schemes
};

struct SweepOptions {
  double duration = 0; // [s]
  int steps = 8;
  bool above_limit = true;
};

// By decreasing step or tolerance. `scene` is any of the preset: only its limits are asked for.
std::vector<Knob> sweep_of(const Scheme& scheme, const Scene& scene, const SweepOptions& options);

// The least number of steps of which none is longer than `step` [s] and that meets the samples.
long steps_within(double duration, double step);

// The step that bounds how explicit schemes resolve the scene: symplectic's limit, or a sixteenth of the
// stretch.
double natural_step(const Scene& scene, double duration);

} // namespace rend
