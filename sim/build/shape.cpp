#include "sim/build/shape.h"

#include "sim/base/math.h"
#include "sim/base/reach.h"

namespace rend {

const std::vector<ShapeType>& all_shapes() {
  static const std::vector<ShapeType> shapes{sheet_shape(),   bar_shape(),  tube_shape(),
                                             outline_shape(), mesh_shape(), create_shape()};
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

template <> const Fields<Placement>& fields_of() {
  using S = Placement;
  static const Fields<S> fields{
      field(&S::scale, number("scale", "", "factor").above(0)),
      field(&S::rotate, numbers("rotate", 3, "degrees", "angles about x, then y, then z")),
      field(&S::translate, numbers("translate", 3, "m", "displacement; applied last")),
      field(&S::velocity, velocity("velocity", "initial velocity")),
      field(&S::spin, within(numbers("spin", 3, "degrees/s",
                                     "initial angular velocity about the centre of mass, in world coordinates"),
                             most_degrees))};
  return fields;
}

std::vector<AttributeType> attributes_at_rest() {
  std::vector<AttributeType> all = attributes_of<Placement>();
  std::erase_if(all, [](const AttributeType& one) { return one.name == "velocity" || one.name == "spin"; });
  return all;
}

void Placement::apply(std::vector<Vec3>& points) const {
  const Eigen::Matrix3d turn =
      scale * rotation_about(2, rotate.z()) * rotation_about(1, rotate.y()) * rotation_about(0, rotate.x());
  for (Vec3& x : points) x = (turn * x).eval() + translate;
}

} // namespace rend
