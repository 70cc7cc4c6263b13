// Where a scene is seen from: what <camera> says, or what fits the bodies. One path for the whole clip,
// worked out before the first step, so that a frame does not depend on the frames before it.
#pragma once

#include "render/frame.h"
#include "sim/scene/scene.h"

#include <Eigen/Geometry>

namespace rend {

// A box that the bodies and obstacles hardly leave: where they are, where they are driven to by `duration`, and
// room below them to hang or fall (as deep as they are wide where nothing holds them up on all sides, but not
// below the floor). Of a sphere that moves, only what it passes between the start and the end of the bodies'
// room counts.
Eigen::AlignedBox3d room_of(const Scene& scene, double duration);

class Viewpoint {
public:
  // aspect: width / height. UserError where the camera looks at nothing.
  Viewpoint(const Node& preset, const Scene& scene, double aspect, double duration);

  FrameCamera at(double time) const; // [s]

private:
  FrameCamera start_;
  double turn_ = 0; // [degrees] over the clip
  double duration_ = 0;
};

} // namespace rend
