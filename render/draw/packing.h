// Packs the corners of a frame's bodies for upload to the vertex buffer.
//
// One pass copies the corners, leaves out triangles that are too far away to be drawn (frame.h), checks that
// the others are finite, gives flat triangles their normal, and reorders triangles of sheets to wind
// counter-clockwise around their normals: from then on "front" is the side that the normals point to. Triangles
// of solids keep their winding. Places in pictures go with their corners.
#pragma once

#include "render/draw/frame.h"

#include <Eigen/Geometry>
#include <span>
#include <vector>

namespace rend {

// The bounding box of corners [m]; empty if there are none.
Eigen::AlignedBox3d bounds_of(std::span<const Corner> corners);

// Appends the corners of what can be drawn of `body` to `packed`, and of a body with a texture their places in
// it to `points`. Degenerate triangles keep a zero normal. CHECK: three corners a triangle, a place for each if
// there is a texture, and all numbers finite.
void pack(const FrameBody& body, std::vector<Corner>& packed, std::vector<TexturePoint>& points);

} // namespace rend
