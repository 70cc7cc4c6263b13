// How spheres and boxes are shown: triangles with smooth normals, and no lines.
//
// Both are one shape, a box with rounded edges: the points of a sphere, moved outwards by the box that is left
// without its roundings. Of a sphere nothing is left; a box has edges that catch the light.
#pragma once

#include "render/draw/frame.h"
#include "render/picture/colour.h"
#include "sim/outside/world.h"

namespace rend {

// The surface of all points within `radius` [m] of the box around `centre` of half sizes `core` [m]; `segments`
// (above 0) to each eighth of a turn. Counter-clockwise from outside.
FrameBody rounded_box(const Vec3& centre, const Vec3& core, double radius, int segments, const Colour& colour);

FrameBody picture_of(const Sphere& sphere);
FrameBody picture_of(const Box& box);

} // namespace rend
