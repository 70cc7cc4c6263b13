// The largest stable step, found by running the scene.
#pragma once

#include "sim/check/case.h"

namespace rend {

// [s], to 1e-3; 0 or infinity where every step that was tried was not stable, or was.
//
// Runs of 4000 steps from small random velocities about the state at the start: not stable is a step in whose
// last half the mean kinetic energy is more than twice that of the second quarter (nothing drives the scene;
// below its limit a scheme without damping beats, but over fifty steps, not over a thousand), or that throws.
// `guess` [s] says only where to begin: the search widens until it has a stable step and one that is not.
double bisected_limit(const Bench& bench, double guess);

} // namespace rend
