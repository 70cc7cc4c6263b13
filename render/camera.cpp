#include "render/camera.h"

#include "sim/base/check.h"

#include <algorithm>
#include <array>
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

  // Depth has 24 bits: far / near is kept below 5,000.
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

PixelBox covered_by(const Eigen::AlignedBox3d& bounds, const View& view, int width, int height) {
  CHECK(!bounds.isEmpty());
  std::array<Eigen::Vector3d, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = bounds.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
  return covered_by(corners, view, width, height);
}

PixelBox covered_by(std::span<const Eigen::Vector3d> points, const View& view, int width, int height) {
  const PixelBox whole{0, 0, width, height};
  const Eigen::Matrix4d world_to_clip = view.world_to_clip();
  Eigen::AlignedBox2d seen; // in [-1, 1]² of the picture
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector4d clip = world_to_clip * point.homogeneous();
    if (clip.w() < 1e-6 * view.distance) return whole; // behind the eye or beside it
    seen.extend(Eigen::Vector2d(clip.head<2>() / clip.w()));
  }
  constexpr int block = 16;
  const auto low = [](double at, int size) { // a pixel of margin for rounding
    const double pixel = std::clamp((0.5 * at + 0.5) * size - 1, 0.0, static_cast<double>(size));
    return static_cast<int>(pixel) / block * block;
  };
  const auto high = [](double at, int size) {
    const double pixel = std::clamp((0.5 * at + 0.5) * size + 1, 0.0, static_cast<double>(size));
    return std::min((static_cast<int>(pixel) / block + 1) * block, size);
  };
  const int x = low(seen.min().x(), width), y = low(seen.min().y(), height);
  return {x, y, high(seen.max().x(), width) - x, high(seen.max().y(), height) - y};
}

PixelBox both(const PixelBox& a, const PixelBox& b) {
  if (a.width == 0 || a.height == 0) return b;
  if (b.width == 0 || b.height == 0) return a;
  const int x = std::min(a.x, b.x), y = std::min(a.y, b.y);
  return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

PixelBox common(const PixelBox& a, const PixelBox& b) {
  const int x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  const int width = std::min(a.x + a.width, b.x + b.width) - x;
  const int height = std::min(a.y + a.height, b.y + b.height) - y;
  return width > 0 && height > 0 ? PixelBox{x, y, width, height} : PixelBox{};
}

std::vector<PixelBox> without(const PixelBox& all, const PixelBox& hole) {
  const PixelBox gone = common(all, hole);
  if (gone.width == 0) return {all};
  const int right = gone.x + gone.width, top = gone.y + gone.height;
  std::vector<PixelBox> left{{all.x, all.y, all.width, gone.y - all.y},
                             {all.x, top, all.width, all.y + all.height - top},
                             {all.x, gone.y, gone.x - all.x, gone.height},
                             {right, gone.y, all.x + all.width - right, gone.height}};
  std::erase_if(left, [](const PixelBox& box) { return box.width == 0 || box.height == 0; });
  return left;
}

FrameCamera frame_auto(const Eigen::AlignedBox3d& bounds, double fov, double aspect,
                       const Eigen::Vector3d& direction) {
  CHECK(!bounds.isEmpty() && direction.allFinite() && direction.norm() > 0);
  CHECK(fov > 0 && fov < 180 && aspect > 0);
  constexpr double margin = 1.12; // a twelfth of the picture stays free
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
