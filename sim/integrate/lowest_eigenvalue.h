// The lowest eigenvalue of the tangent, a test of stability, when the tangent is not symmetric.
//
//   J φ = λ M φ,   J = −∂(f + load)/∂x at the free coordinates;   the smallest λ [1/s²]
//
// The forces of elements with one average rotation have no potential. The symmetric part A of their tangent J
// only bounds λ from below, and for nearly incompressible materials A is indefinite in states that are stable.
// With a shift s such that A + s M is positive definite, all λ are above −s, and inverse iteration
//
//   φ ← (J + s M)⁻¹ M φ
//
// converges to the smallest one. Each system is solved by GMRES preconditioned by the factor of A + s M
// (load_tangent.h).
#pragma once

#include "sim/integrate/load_tangent.h"

namespace rend {

// An equilibrium: positions [m], velocities of 0 [m/s], constrained axes; one entry per vertex slot.
struct Equilibrium {
  System& system;
  double time; // [s]
  const Records &position, &still;
  const std::vector<std::uint8_t>& held;
};

// λ [1/s²], to a hundredth of its distance from −s; −∞ if it was not found. The last three arguments are
// overwritten.
double lowest_eigenvalue(const Equilibrium& at, BlockMatrix& matrix, LinearSolver& linear,
                         LoadTangent& tangent);

} // namespace rend
