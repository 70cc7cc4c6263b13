// Where a scene is seen from: what CameraSettings say, or what fits the bodies.
//
// A given, fitted, turning or keyed camera has one path for the whole clip, computed before the first step. A
// following camera needs the state of every frame (observe): it follows the centre of the bodies like a damped
// spring, and keeps far enough away to have all of them in the picture.
#pragma once

#include "render/draw/frame.h"
#include "render/picture/camera_settings.h"
#include "sim/scene/scene.h"

#include <Eigen/Geometry>
#include <vector>

namespace rend {

// The bounding box of a body's current vertices [m]; empty if it has none.
Eigen::AlignedBox3d bounds_of(const Body& body);

// A box that bodies and obstacles hardly leave: their positions, the targets of driven ones by `duration`, and
// room below to hang or fall (as deep as the bodies are wide unless they are held on all sides, but not below
// the floor). Of a moving sphere, only the part of its path counts that is between the start and the end of the
// bodies' box.
Eigen::AlignedBox3d bounds_to_frame(const Scene& scene, double duration);

class Viewpoint {
public:
  // aspect: width / height; duration of the clip [s]. UserError where the camera looks at nothing, or its
  // settings do not fit together.
  Viewpoint(const CameraSettings& camera, const Scene& scene, double aspect, double duration);

  void observe(const Scene& scene); // call with the state of each frame; needed only by a following camera
  bool has_observed(double time) const {
    return last_ == time;
  }                                         // [s]: of the last state observed, if it follows
  FrameCamera at(double time) const;        // [s]
  void store(Archive& archive, double now); // [s]: state of a following camera; checkpoint

private:
  struct Key {
    double time;                        // [s]
    Eigen::Matrix<double, 7, 1> camera; // eye, target [m], fov [degrees]
  };
  void read_keys(const CameraSettings& camera);
  FrameCamera between_keys(double time) const;

  FrameCamera start_;
  std::vector<Key> keys_; // ordered by time; empty: start_ is used
  bool follows_ = false;
  // width / height; distance from the initial centre within which bodies are followed [m]
  double aspect_ = 1, reach_ = 0;
  Vec3 start_middle_ = Vec3::Zero(); // [m], of the bodies
  Vec3 direction_ = Vec3::Zero();    // towards the eye, of a following camera
  double last_ = -1;                 // [s], of the last state observed
  double turn_ = 0;                  // [degrees] turned over the clip
  double duration_ = 0;
};

} // namespace rend
