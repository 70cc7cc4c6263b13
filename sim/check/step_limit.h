// The largest stable step of a scheme on a body, computed with the scheme itself: where the spectral radius of
// its amplification matrix exceeds 1.
//
// One mode (ω², d): the scheme steps an oscillator of one particle from (1, 0) and from (0, 1), which gives its
// 2 × 2 matrix, and the step is found by bisection. So no formula is taken for granted: this must reproduce
// those of the time schemes (sim/README.md, "Time schemes").
//
// A body whose damping couples modes has no such formula. There the matrix is that of the linearised body
// (linearised.h), in the coordinates (ω √m x, √m v), in which undamped motion is a rotation. Its eigenvalues
// are computed by Arnoldi's method started at the highest mode. Modes whose accelerations by stiffness and
// damping are below a tenth of ω times their speed are skipped: rigid body motions are a double eigenvalue of 1
// with one eigenvector, which an iteration cannot distinguish from growth. A mode counts as growing if it grows
// by more than its residual. With Rayleigh damping, a combination of mass and stiffness, both methods agree (a
// test).
#pragma once

#include "sim/check/linearised.h"

namespace rend {

// [s]; 0: no step is stable, infinity: all are.
double step_limit_of_mode(const Scheme& scheme, double omega_squared, double damping_rate);

struct StepLimit {
  double omega = 0;        // [1/s], the highest frequency, by Lanczos
  double damping_rate = 0; // [1/s], of that mode
  double of_mode = 0;      // [s]: step_limit_of_mode with these
  double step = 0;         // [s]: of the whole linearised body
};

StepLimit step_limit(const Scheme& scheme, Linearised& body);

// Whether a high mode of the linearised body grows with the scheme at this step.
bool grows(const Scheme& scheme, Linearised& body, const HighestMode& mode, double step);

} // namespace rend
