// The largest stable step, found by running the scene.
#pragma once

#include "sim/check/case.h"

namespace rend {

// [s]. Runs of 4000 steps from small random velocities about the state at the start: a step is stable if the energy of
// the perturbation does not grow by 1e6. `omega` [1/s] says only where to look: from 0.01/ω to 20/ω. To 5e-4.
double bisected_limit(const Bench& bench, double omega);

} // namespace rend
