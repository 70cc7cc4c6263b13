// Where a scene is seen from: what CameraSettings say, or what fits the bodies.
//
// A given, fitted, turning or keyed camera has one path for the whole clip, worked out before the first step.
// One that follows the bodies looks at every frame's state (observe): it goes after their middle as if on a
// damped spring, and is never so near that one of them leaves the picture.
#pragma once

#include "render/draw/frame.h"
#include "render/picture/camera_settings.h"
#include "sim/scene/scene.h"

#include <Eigen/Geometry>
#include <vector>

namespace rend {

// The box around a body's vertices as they are [m]; empty if it has none.
Eigen::AlignedBox3d bounds_of(const Body& body);

// A box that the bodies and obstacles hardly leave: where they are, where they are driven to by `duration`, and
// room below them to hang or fall (as deep as they are wide where nothing holds them up on all sides, but not
// below the floor). Of a sphere that moves, only what it passes between the start and the end of the bodies'
// room counts.
Eigen::AlignedBox3d room_of(const Scene& scene, double duration);

class Viewpoint {
public:
  // aspect: width / height; duration of the clip [s]. UserError where the camera looks at nothing, or its
  // settings do not fit together.
  Viewpoint(const CameraSettings& camera, const Scene& scene, double aspect, double duration);

  void observe(const Scene& scene);  // the state is that of a frame; only needed by a camera that follows
  FrameCamera at(double time) const; // [s]
  void store(Archive& archive, double now); // [s]: where one that follows has come to

private:
  struct Key {
    double time;                        // [s]
    Eigen::Matrix<double, 7, 1> camera; // eye, target [m], fov [degrees]
  };
  void read_keys(const CameraSettings& camera);
  FrameCamera between_keys(double time) const;

  FrameCamera start_;
  std::vector<Key> keys_; // in order of time; empty: start_ holds
  bool follows_ = false;
  double aspect_ = 1, reach_ = 0;    // width / height; how far from the start's middle bodies are followed [m]
  Vec3 start_middle_ = Vec3::Zero(); // [m], of the bodies
  Vec3 direction_ = Vec3::Zero();    // towards the eye, of a camera that follows
  double last_ = -1;                 // [s], of the last state observed
  double turn_ = 0;                  // [degrees] over the clip
  double duration_ = 0;
};

} // namespace rend
