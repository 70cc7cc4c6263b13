// How the motion that is resisted least is resisted, where the tangent is not symmetric.
//
//   J φ = λ M φ,   J = −∂(f + load)/∂x at the free coordinates;   the least λ [1/s²]
//
// Elements that turn by one mean rotation give no gradient. The symmetric part A of their tangent J bounds λ
// from below alone, and where volumes are next to incompressible, A is no more positive in states in which
// every motion comes to rest again. With a shift s from which on A + s M is positive, all λ lie above −s, and
// inverse iteration
//
//   φ ← (J + s M)⁻¹ M φ
//
// goes to the least one. Each system is solved by GMRES with the factor of A + s M (load_tangent.h).
#pragma once

#include "sim/integrate/load_tangent.h"

namespace rend {

// An equilibrium: positions [m], velocities of 0 [m/s], held axes; one per vertex slot.
struct Standing {
  System& system;
  double time; // [s]
  const Records &position, &still;
  const std::vector<std::uint8_t>& held;
};

// λ [1/s²], to a hundredth of the distance from −s; −∞ where it was not found. All three are written.
double least_resistance(const Standing& at, BlockMatrix& matrix, LinearSolver& linear, LoadTangent& tangent);

} // namespace rend
