// A wall between two pieces of a body (build/pieces.h): a convex part of a plane.
#pragma once

#include "sim/base/record.h"

#include <span>
#include <vector>

namespace rend {

struct OrientedPlane {
  Vec3 normal = Vec3::Zero(); // a unit vector
  double offset = 0;          // [m]

  static OrientedPlane through(const Vec3& point, const Vec3& unit) { return {unit, unit.dot(point)}; }
  double height(const Vec3& x) const { return normal.dot(x) - offset; } // [m]
  OrientedPlane turned() const { return {-normal, -offset}; }
};

struct Wall {
  OrientedPlane plane;
  std::vector<OrientedPlane> bounds = {}; // it reaches as far as no height above any of them is above 0
};

// What remains of a convex polygon below a plane, or at most `slack` [m] above it. Of two corners: a segment.
std::vector<Vec3> clipped(std::span<const Vec3> polygon, const OrientedPlane& plane, double slack = 0);

} // namespace rend
