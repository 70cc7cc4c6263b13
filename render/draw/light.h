// The lights of the studio, and what the shadow maps cover.
//
// Everything here is a pure function of the frame, so that a frame drawn alone is the frame of the whole clip,
// and yet it is steady: the light stands still unless the camera moves (or stands where the frame says), and a
// shadow map covers a square whose side is a power of √2 and whose centre moves by whole texels. A texel of the
// map is therefore a fixed spot in the scene, and shadow edges do not crawl. (Fitting the map to the first
// frame would be as steady, but then a frame would depend on where the clip began.)
#pragma once

#include "render/draw/camera.h"
#include "render/draw/frame.h"

namespace rend {

// A square seen along an axis, by an orthographic view: x and y across it, z towards the light.
struct LightView {
  Eigen::Matrix4d world_to_clip; // the square to [-1, 1]²; depth -1 is nearest to the light
  double half = 1;               // half the side of the square [m]
};

struct Lights {
  Eigen::Vector3d sky;  // unit, upwards: z where there is a floor, the camera's up otherwise
  Eigen::Vector3d key;  // unit, towards the key light
  Eigen::Vector3d fill; // unit, towards the weak light that opens the shadows
};

Lights lights_of(const Frame& frame);

// The box that shadows are worked out for: `bounds`, cut to what is near enough to the camera's target to be
// seen.
Eigen::AlignedBox3d lit_bounds(const FrameCamera& camera, double aspect, const Eigen::AlignedBox3d& bounds);

// A view along `towards` (unit, from the scene to the light) that covers `bounds` with a margin. Steps of the
// square's centre are whole texels of any map of up to 2048² texels that is at least 32 wide.
LightView light_view(const Eigen::Vector3d& towards, const Eigen::AlignedBox3d& bounds);

} // namespace rend
