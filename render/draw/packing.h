// Packs the corners of a frame's bodies for upload to the vertex buffer.
//
// One pass copies the corners, checks that they are finite, gives flat triangles their normal, and reorders
// triangles of sheets to wind counter-clockwise around their normals: from then on "front" is the side that the
// normals point to. Triangles of solids keep their winding.
#pragma once

#include "render/draw/frame.h"

#include <Eigen/Geometry>
#include <span>
#include <vector>

namespace rend {

// The bounding box of its corners [m]; empty if there are none.
Eigen::AlignedBox3d bounds_of(const FrameBody& body);

// Appends the corners of `body` to `packed`. Degenerate triangles keep a zero normal. CHECK: three corners a
// triangle, and all numbers finite.
void pack(const FrameBody& body, std::vector<Corner>& packed);

} // namespace rend
