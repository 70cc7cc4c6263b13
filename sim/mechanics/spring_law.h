// The force of a damped spring between particles i and j (thesis 2.2, 2.4):
//
//   u = (xj − xi)/|xj − xi|,   f_i = (k(|xj − xi| − l0) + λ (vj − vi)·u) u,   f_j = −f_i
//
// The sign of the damping is corrected against the thesis's print, so that it dissipates. At |xj − xi| = 0 there is
// no direction, and no force. This is the reference; the program's kernel computes four at a time.
#pragma once

#include "sim/mechanics/interaction.h"

#include <cmath>

namespace rend {

inline Vec3 spring_force(const UnitParameters& p, const Vec3& xi, const Vec3& xj, const Vec3& vi,
                         const Vec3& vj) {
  const Vec3 d = xj - xi;
  const double length = std::sqrt(d.x() * d.x() + d.y() * d.y() + d.z() * d.z());
  if (length == 0) return Vec3::Zero();
  const Vec3 u = d / length;
  return (p.k * (length - p.rest) + p.damping * (vj - vi).dot(u)) * u;
}

inline double spring_energy(const UnitParameters& p, const Vec3& xi, const Vec3& xj) {
  const double stretch = (xj - xi).norm() - p.rest;
  return 0.5 * p.k * stretch * stretch;
}

} // namespace rend
