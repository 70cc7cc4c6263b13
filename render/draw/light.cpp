#include "render/draw/light.h"

#include "sim/base/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rend {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The smallest power of √2 not below x > 0. Its mantissa is one of two constants, so the result is the same on
// every machine.
double power_of_root_two(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent); // x = mantissa 2^exponent, mantissa in [1/2, 1)
  constexpr double half_root = 0.70710678118654752;
  return std::ldexp(mantissa <= half_root ? half_root : 1.0, exponent);
}

// Columns: two unit vectors perpendicular to `towards`, and `towards`.
Matrix3d across(const Vector3d& towards) {
  const Vector3d other = std::abs(towards.z()) < 0.99 ? Vector3d::UnitZ() : Vector3d::UnitY();
  const Vector3d x = other.cross(towards).normalized();
  Matrix3d axes;
  axes << x, towards.cross(x), towards;
  return axes;
}

} // namespace

Lights lights_of(const Frame& frame) {
  const FrameCamera& camera = frame.camera;
  Lights lights;
  lights.sky = frame.floor ? Vector3d::UnitZ() : camera.up.normalized();
  const Vector3d& sky = lights.sky;
  Vector3d back = camera.eye - camera.target; // horizontal, towards the camera
  back -= sky * sky.dot(back);
  if (back.norm() < 1e-3 * (camera.eye - camera.target).norm()) back = -(camera.up - sky * sky.dot(camera.up));
  if (back.norm() < 1e-9) back = across(sky).col(0);
  back.normalize();
  const Vector3d right = sky.cross(back);
  // Key: over the left shoulder, 40° high, and never below the floor. Fill: from the right, low.
  lights.key = frame.light ? *frame.light : -0.62 * right + 0.42 * back + 0.63 * sky;
  CHECK(lights.key.allFinite() && lights.key.norm() > 0);
  lights.key.normalize();
  if (frame.floor) lights.key.z() = std::max(lights.key.z(), 0.15);
  lights.key.normalize();
  lights.fill = (0.85 * right + 0.45 * back + 0.25 * sky).normalized();
  return lights;
}

Eigen::AlignedBox3d lit_bounds(const FrameCamera& camera, double aspect, const Eigen::AlignedBox3d& bounds) {
  const double distance = (camera.eye - camera.target).norm();
  const double reach = 1.3 * distance * std::tan(camera.fov * std::numbers::pi / 360) * std::max(aspect, 1.0);
  const Vector3d corner = Vector3d::Constant(reach);
  const Eigen::AlignedBox3d seen(camera.target - corner, camera.target + corner);
  const Eigen::AlignedBox3d lit = bounds.intersection(seen);
  return lit.isEmpty() ? seen : lit;
}

LightView light_view(const Vector3d& towards, const Eigen::AlignedBox3d& bounds) {
  const Matrix3d axes = across(towards);
  Eigen::AlignedBox3d box; // in the light's axes
  for (int i = 0; i < 8; ++i)
    box.extend(Vector3d(axes.transpose() * bounds.corner(Eigen::AlignedBox3d::CornerType(i))));
  LightView view;
  const Vector3d sizes = box.sizes();
  constexpr double margin = 1.15; // room for half a step of the centre and for the blur of the shadow's edges
  const double side = std::max({sizes.x(), sizes.y(), 1e-6});
  view.half = power_of_root_two(0.5 * side * margin);
  const double depth = power_of_root_two(std::max(0.5 * sizes.z() * margin, view.half));
  const double step = view.half / 16; // 64 texels of 2048, 1 of 32
  Vector3d centre = box.center();
  for (double& x : centre) x = step * std::floor(x / step + 0.5);

  Matrix3d scaled = axes.transpose();
  scaled.row(0) /= view.half;
  scaled.row(1) /= view.half;
  scaled.row(2) /= -depth; // depth grows away from the light
  view.world_to_clip.setIdentity();
  view.world_to_clip.topLeftCorner<3, 3>() = scaled;
  view.world_to_clip(0, 3) = -centre.x() / view.half;
  view.world_to_clip(1, 3) = -centre.y() / view.half;
  view.world_to_clip(2, 3) = centre.z() / depth;
  return view;
}

} // namespace rend
