// The view and projection matrices of a FrameCamera, and a camera that frames a box.
#pragma once

#include "render/draw/frame.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace rend {

struct View {
  Eigen::Matrix4d world_to_eye; // the camera looks along -z
  Eigen::Matrix4d eye_to_clip;  // OpenGL's: depth in [-1, 1]
  Eigen::Vector3d eye;          // [m]
  double distance = 1;          // from eye to target [m]
  Eigen::Matrix4d world_to_clip() const { return eye_to_clip * world_to_eye; }
};

// The view of `camera` in a picture of width / height = `aspect`. Near and far planes enclose `bounds` (of what
// is drawn; may be empty) tightly, for the precision of the depth buffer. An up vector along the line of sight
// is replaced. CHECK: finite numbers, eye apart from target, 0 < fov < 180.
View view_of(const FrameCamera& camera, const Eigen::AlignedBox3d& bounds, double aspect);

// A camera that looks at the centre of `bounds` from `direction` (from the box towards the eye, any length), as
// near as possible with the whole box and a margin in view. fov: vertical angle [degrees].
FrameCamera fit_camera(const Eigen::AlignedBox3d& bounds, double fov, double aspect,
                       const Eigen::Vector3d& direction);

} // namespace rend
