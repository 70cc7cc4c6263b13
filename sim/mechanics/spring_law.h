// The force of a damped spring between particles i and j (thesis 2.2, 2.4):
//
//   u = (xj − xi)/|xj − xi|,   f_i = (k(|xj − xi| − l0) + λ (vj − vi)·u) u,   f_j = −f_i
//
// The sign of the damping is corrected from the thesis, so that it dissipates. At |xj − xi| = 0 there is no
// direction, and the force is 0. The tangent, with s = 1 − l0/|xj − xi| (the geometric stiffness; in the
// semi-definite tangent max(s, 0)):
//
//   −∂f_i/∂x_i = k (s (I − u uᵀ) + u uᵀ),   −∂f_i/∂v_i = λ u uᵀ,   and the opposite for j
#pragma once

#include "sim/mechanics/force_law.h"

#include <memory>

namespace rend {

Vec3 spring_force(const UnitParameters& p, const Vec3& xi, const Vec3& xj, const Vec3& vi, const Vec3& vj);
double spring_energy(const UnitParameters& p, const Vec3& xi, const Vec3& xj); // [J]

const std::shared_ptr<const ForceLaw>& spring_law(); // 2 particles; k, damping, rest length

} // namespace rend
