#include "sim/build/shape.h"

#include "sim/base/math.h"

namespace rend {

const std::vector<ShapeType>& all_shapes() {
  static const std::vector<ShapeType> shapes{sheet_shape(), bar_shape(), tube_shape(), mesh_shape()};
  return shapes;
}

namespace {

Eigen::Matrix3d rotation_about(int axis, double degrees) {
  const double c = cosine_of_degrees(degrees), s = sine_of_degrees(degrees);
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
  r(j, j) = r(k, k) = c;
  r(j, k) = -s;
  r(k, j) = s;
  return r;
}

} // namespace

Placement::Placement(const PresetNode* place) {
  if (!place) return;
  const Vec3 angles = place->vector("rotate");
  turn = place->number("scale") * rotation_about(2, angles.z()) * rotation_about(1, angles.y()) *
         rotation_about(0, angles.x());
  shift = place->vector("translate");
}

void Placement::apply(std::vector<Vec3>& points) const {
  for (Vec3& x : points) x = (turn * x).eval() + shift;
}

} // namespace rend
