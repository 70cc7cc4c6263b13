// Bodies of a frame, made ready for the graphics card.
//
// One pass over the corners copies them, checks that they are finite, gives flat triangles their normal, and
// turns triangles of sheets so that they wind around their normals: from then on "front" means the side that
// the normals point to. Those of solids are wound as they should be.
#pragma once

#include "render/draw/frame.h"

#include <Eigen/Geometry>
#include <span>
#include <vector>

namespace rend {

// Bounds of its corners; empty if there are none. [m]
Eigen::AlignedBox3d bounds_of(const FrameBody& body);

// Appends the corners of `body` to `packed`. Triangles without area keep a zero normal.
// CHECK: three corners a triangle, and all numbers finite.
void pack(const FrameBody& body, std::vector<Corner>& packed);

} // namespace rend
