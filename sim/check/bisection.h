// The largest stable step, found by running the scene.
#pragma once

#include "sim/check/case.h"

namespace rend {

// [s], to 1e-3; 0 or infinity if every step tried was unstable, or stable.
//
// Runs 4000 steps from small random velocities about the initial state: a step is unstable if the mean kinetic
// energy of the last half is more than twice that of the second quarter (nothing drives the scene; below its
// limit a scheme without damping shows beats, but with a period of fifty steps, not a thousand), or if it
// throws. `guess` [s] is only the start of the search, which widens until it has a stable step and an unstable
// one.
double bisected_limit(const Bench& bench, double guess);

} // namespace rend
