#include "render/draw/camera.h"

#include "sim/base/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rend {
namespace {

using Eigen::Vector3d;

double half_tangent(double fov) {
  return std::tan(fov * std::numbers::pi / 360);
}

// Columns: right, up, backwards (towards the eye).
Eigen::Matrix3d axes_of(const Vector3d& back, const Vector3d& wanted_up) {
  Vector3d right = wanted_up.cross(back);
  for (const Vector3d& other : {Vector3d(0, 1, 0), Vector3d(1, 0, 0)}) // looking straight along `up`
    if (right.norm() < 1e-6 * wanted_up.norm()) right = other.cross(back);
  right.normalize();
  Eigen::Matrix3d axes;
  axes << right, back.cross(right), back;
  return axes;
}

} // namespace

View view_of(const FrameCamera& camera, const Eigen::AlignedBox3d& bounds, double aspect) {
  CHECK(camera.eye.allFinite() && camera.target.allFinite() && camera.up.allFinite());
  CHECK(camera.fov > 0 && camera.fov < 180 && aspect > 0);
  View view;
  view.eye = camera.eye;
  view.distance = (camera.eye - camera.target).norm();
  CHECK(view.distance > 0 && camera.up.norm() > 0);
  const Eigen::Matrix3d axes = axes_of((camera.eye - camera.target) / view.distance, camera.up);
  view.world_to_eye.setIdentity();
  view.world_to_eye.topLeftCorner<3, 3>() = axes.transpose();
  view.world_to_eye.topRightCorner<3, 1>() = -axes.transpose() * camera.eye;

  // The depth buffer has 24 bits: far / near is kept below 5,000.
  double nearest = view.distance, farthest = view.distance;
  if (!bounds.isEmpty()) {
    nearest = 1e300;
    farthest = 0;
    for (int i = 0; i < 8; ++i) {
      const double depth = (camera.eye - bounds.corner(Eigen::AlignedBox3d::CornerType(i))).dot(axes.col(2));
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
  }
  const double far = std::max(farthest, view.distance) * 1.05;
  const double near = std::max(0.9 * std::min(nearest, view.distance), far / 5000);
  const double up = 1 / half_tangent(camera.fov);
  view.eye_to_clip.setZero();
  view.eye_to_clip(0, 0) = up / aspect;
  view.eye_to_clip(1, 1) = up;
  view.eye_to_clip(2, 2) = -(far + near) / (far - near);
  view.eye_to_clip(2, 3) = -2 * far * near / (far - near);
  view.eye_to_clip(3, 2) = -1;
  return view;
}

FrameCamera fit_camera(const Eigen::AlignedBox3d& bounds, double fov, double aspect,
                       const Eigen::Vector3d& direction) {
  CHECK(!bounds.isEmpty() && direction.allFinite() && direction.norm() > 0);
  CHECK(fov > 0 && fov < 180 && aspect > 0);
  constexpr double margin = 1.12; // leaves about a twelfth of the picture free
  FrameCamera camera;
  camera.fov = fov;
  camera.target = bounds.center();
  const Eigen::Matrix3d axes = axes_of(direction.normalized(), camera.up);
  const double tangent = half_tangent(fov);
  double distance = 0;
  for (int i = 0; i < 8; ++i) {
    const Vector3d corner = bounds.corner(Eigen::AlignedBox3d::CornerType(i)) - camera.target;
    const Vector3d seen = axes.transpose() * corner;
    const double needed = std::max(std::abs(seen.x()) / aspect, std::abs(seen.y())) * margin / tangent;
    distance = std::max(distance, seen.z() + needed);
  }
  if (distance <= 0) distance = 1; // a single point
  camera.eye = camera.target + distance * axes.col(2);
  return camera;
}

} // namespace rend
