// How far a triangle is from a box, along the axis on which it is farthest: what does not overlap is apart on
// one of the sides of the box, the normal of the triangle, or a product of an edge of each (Gottschalk, Lin,
// Manocha, "OBBTree", 1996; Akenine-Möller, "Fast 3D triangle-box overlap testing", 2001).
#pragma once

#include "sim/outside/obstacle.h"

namespace rend {

struct BoxSeparation {
  Plane plane;         // that holds the box on its negative side, and touches it
  double distance = 0; // [m], of the nearest corner of the triangle from the plane; negative: they overlap
};

// In the frame of the box.
BoxSeparation separation(const Box& box, const TriangleCorners& x);

} // namespace rend
