// An inelastic impact with Coulomb's friction, between what yields differently along each axis.
//
// A vertex that is held along an axis is infinitely heavy along it: what holds it takes the momentum. So the
// inverse mass K of two that meet is a diagonal matrix, and an impulse J changes their relative velocity u by
// K J. With the normal n:
//
//   J_n = max(0, −u·n)/(n·K n) n,   u' = u + K J_n,   s = u' less its part along n
//   J_t = −min(s·s/(s·K s), μ |J_n|/|s|) s
//
// Its work is never positive: each of the two takes what speed there is along itself, or less.
#pragma once

#include "sim/base/record.h"

namespace rend {

struct Impulse {
  Vec3 normal = Vec3::Zero(), friction = Vec3::Zero(); // [N·s]
  Vec3 whole() const { return normal + friction; }
};

// `u` [m/s], unit `normal`; `yields`: the diagonal of K [1/kg], of both sides together. 0 where that is 0 along
// n.
Impulse impact(const Vec3& u, const Vec3& normal, double friction, const Vec3& yields);

// n·K n: by how much an impulse along n changes the velocity along it [1/kg].
inline double yield_along(const Vec3& normal, const Vec3& yields) {
  return normal.dot(yields.cwiseProduct(normal));
}

} // namespace rend
