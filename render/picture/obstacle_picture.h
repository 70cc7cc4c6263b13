// Pictures of obstacles: triangles with smooth normals, without lines.
//
// Spheres and boxes are the same shape, a rounded box: the points of a sphere, offset by the corners of an
// inner box. For a sphere the inner box is a point; a box has rounded edges that show highlights.
#pragma once

#include "render/draw/frame.h"
#include "render/picture/colour.h"
#include "sim/outside/world.h"

namespace rend {

// What only pictures ask of <sphere>, <box> and <obstacle>.
struct SphereLook {
  Colour colour{0xc9, 0xa2, 0x27};
  SettingsSource source = {};
};
struct BoxLook {
  Colour colour{0x8a, 0x8f, 0x98};
  SettingsSource source = {};
};
struct MeshLook {
  Colour colour{0xb8, 0xb2, 0xa7};
  SettingsSource source = {};
};
template <> const Fields<SphereLook>& fields_of();
template <> const Fields<BoxLook>& fields_of();
template <> const Fields<MeshLook>& fields_of();

// The surface of all points within `radius` [m] of the box around `centre` of half sizes `core` [m];
// `segments` (above 0) to each eighth of a turn. Counter-clockwise from outside.
FrameBody rounded_box(const Vec3& centre, const Vec3& core, double radius, int segments, const Colour& colour);

FrameBody picture_of(const Sphere& sphere, const SphereLook& look);
FrameBody picture_of(const Box& box, const BoxLook& look, double time = 0); // [s]: where it is then
// As the preset puts it. A face has at a corner the mean normal of the faces around it that are inclined to
// it by less than 40 degrees, weighted by their areas: what is round looks round, and edges stay sharp.
FrameBody picture_of(const MeshObstacle& mesh, const MeshLook& look);
FrameBody moved(FrameBody picture, const Pose& pose); // its points and normals taken there

} // namespace rend
