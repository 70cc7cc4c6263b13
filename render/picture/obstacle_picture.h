// How spheres and boxes are shown: triangles with smooth normals, and no lines.
//
// Both are one shape, a box with rounded edges: the points of a sphere, moved outwards by the box that is left
// without its roundings. Of a sphere nothing is left; a box has edges that catch the light.
#pragma once

#include "render/draw/frame.h"
#include "render/picture/colour.h"
#include "sim/outside/world.h"

namespace rend {

// What only pictures ask of <sphere> and <box>.
struct SphereLook {
  Colour colour{0xc9, 0xa2, 0x27};
  SettingsSource source = {};
};
struct BoxLook {
  Colour colour{0x8a, 0x8f, 0x98};
  SettingsSource source = {};
};
template <> const Fields<SphereLook>& fields_of();
template <> const Fields<BoxLook>& fields_of();

// The surface of all points within `radius` [m] of the box around `centre` of half sizes `core` [m]; `segments`
// (above 0) to each eighth of a turn. Counter-clockwise from outside.
FrameBody rounded_box(const Vec3& centre, const Vec3& core, double radius, int segments, const Colour& colour);

FrameBody picture_of(const Sphere& sphere, const SphereLook& look);
FrameBody picture_of(const Box& box, const BoxLook& look);

} // namespace rend
