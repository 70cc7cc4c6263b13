// The lights of the studio, and the areas that shadow maps cover.
//
// Everything here is a pure function of the frame, so that a frame drawn alone equals the same frame of the
// whole clip. Shadows are stable nevertheless: the light is fixed relative to the camera (or given by the
// frame), and a shadow map covers a square whose side is a power of √2 and whose centre moves by whole texels.
// A texel of the map is therefore a fixed place in the scene, and shadow edges do not crawl. (Fitting the map
// to the first frame would be as stable, but then a frame would depend on where the clip began.)
#pragma once

#include "render/draw/camera.h"
#include "render/draw/frame.h"

namespace rend {

// The orthographic view of a square along an axis: x and y in its plane, z towards the light.
struct LightView {
  Eigen::Matrix4d world_to_clip; // the square to [-1, 1]²; depth -1 is nearest to the light
  double half = 1;               // half the side of the square [m]
};

struct Lights {
  Eigen::Vector3d sky;  // unit, upwards: z if there is a floor, else the camera's up
  Eigen::Vector3d key;  // unit, towards the key light
  Eigen::Vector3d fill; // unit, towards the weak light that brightens the shadows
};

Lights lights_of(const Frame& frame);

// The box that shadows are computed for: `bounds`, clipped to what is near enough to the camera's target to be
// seen.
Eigen::AlignedBox3d lit_bounds(const FrameCamera& camera, double aspect, const Eigen::AlignedBox3d& bounds);

// A view along `towards` (unit, from the scene to the light) that covers `bounds` with a margin. The square's
// centre moves in steps of whole texels of any map that is 32 to 2048 texels wide.
LightView light_view(const Eigen::Vector3d& towards, const Eigen::AlignedBox3d& bounds);

} // namespace rend
