// The largest stable step of a scheme on a body, as the scheme itself has it: where the spectral radius of its
// amplification matrix passes 1.
//
// One mode (ω², d): the scheme steps an oscillator of one particle from (1, 0) and from (0, 1); that is its 2 ×
// 2 matrix, and the step is found by bisection. So no formula is taken on trust: those of mechanics ("Time")
// must come out.
//
// A whole body with damping that couples modes has no such formula. There the matrix is that of the linearised
// body (linearised.h), in the coordinates (ω √m x, √m v), in which an undamped motion turns without growing.
// Its eigenvalues come from Arnoldi's method started at the fastest mode. What stiffness and damping accelerate
// by less than a tenth of ω times its speed is left out: whole bodies that drift or turn are a double
// eigenvalue of 1 with one vector, which no iteration tells from growth. A motion counts as growing where it
// does so by more than its residual. With damping of Rayleigh's kind, a combination of mass and stiffness, both
// agree (a test).
#pragma once

#include "sim/check/linearised.h"

namespace rend {

// [s]; 0: none is stable, infinity: all are.
double step_limit_of_mode(const Scheme& scheme, double omega_squared, double damping_rate);

struct StepLimit {
  double omega = 0;        // the highest frequency [1/s], by Lanczos
  double damping_rate = 0; // of that mode [1/s]
  double of_mode = 0;      // [s]: step_limit_of_mode with these
  double step = 0;         // [s]: of the whole linearised body
};

StepLimit step_limit(const Scheme& scheme, Linearised& body);

// Whether a fast motion of the linearised body grows under the scheme at this step.
bool grows(const Scheme& scheme, Linearised& body, const HighestMode& mode, double step);

} // namespace rend
