// An inelastic impact with Coulomb friction, with anisotropic inverse masses.
//
// A vertex that is constrained along an axis has infinite mass along it: its support takes the momentum. So the
// inverse mass K of a pair is a diagonal matrix, and an impulse J changes their relative velocity u by K J.
// With the normal n:
//
//   J_n = max(0, −u·n)/(n·K n) n,   u' = u + K J_n,   s = u' without its component along n
//   J_t = −min(s·s/(s·K s), μ |J_n|/|s|) s
//
// Its work is never positive: each of the two impulses at most cancels the velocity along itself.
#pragma once

#include "sim/base/record.h"

namespace rend {

struct Impulse {
  Vec3 normal = Vec3::Zero(), friction = Vec3::Zero(); // [N·s]
  Vec3 whole() const { return normal + friction; }
};

// `u` [m/s], unit `normal`; `inverse_masses`: the diagonal of K [1/kg], of both bodies together. 0 if n·K n is
// 0.
Impulse impact(const Vec3& u, const Vec3& normal, double friction, const Vec3& inverse_masses);

// n·K n: the inverse effective mass along n [1/kg].
inline double inverse_mass_along(const Vec3& normal, const Vec3& inverse_masses) {
  return normal.dot(inverse_masses.cwiseProduct(normal));
}

// The depth [m] that a point may still have at the end of a step that was `before` deep at its start, because a
// body starts around an obstacle or was released inside one: it is moved out over 0.05 s, and no faster than
// 0.1 m/s. At once, the elastic forces of so large a deformation would throw it out. 0: it was outside.
double way_out(double before, double step);

} // namespace rend
