#include "sim/mechanics/element_of.h"

#include <cmath>

namespace rend {

using Eigen::Matrix3d;

ElasticMaterial ElasticMaterial::of(double young, double poisson, int dimension) {
  ElasticMaterial m;
  m.mu = young / (2 * (1 + poisson));
  m.lambda = dimension == 2 ? young * poisson / (1 - poisson * poisson)
                            : young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  return m;
}

namespace {

std::string name_of(const ElementShape& shape, const ElementSettings& settings) {
  const std::string enhanced = settings.formulation == Formulation::Enhanced ? "enhanced " : "";
  return enhanced + (settings.model == ElasticModel::Linear ? "linear " : "co-rotational ") + shape.name;
}

} // namespace

ElementLaw::ElementLaw(const ElementShape& shape, const ElementSettings& settings,
                       const ElasticMaterial& material)
    : ForceLaw(name_of(shape, settings), shape.corners,
               unit_values(shape.kind, settings.model, settings.formulation)),
      shape_(&shape), model_(settings.model), rotation_(settings.rotation), material_(material),
      formulation_(settings.formulation) {}

namespace {

// As write_element, with the axes at each point in the tangent plane of the rest element there: a quad that is
// warped at rest then has no strain at rest. False also if it is folded.
bool write_in_tangent_planes(const ElementShape& shape, const Vec3* rest, const Matrix3d& frame,
                             double thickness, double* values) {
  ElementShape one = shape;
  for (const ReferencePoint& point : shape.points) {
    Vec3 along = Vec3::Zero(), across = Vec3::Zero();
    for (int n = 1; n < shape.corners; ++n) {
      along += point.gradient[static_cast<std::size_t>(n)][0] * (rest[n] - rest[0]);
      across += point.gradient[static_cast<std::size_t>(n)][1] * (rest[n] - rest[0]);
    }
    Vec3 normal = along.cross(across).normalized();
    const double side = normal.dot(frame.col(2));
    if (side < 0) normal = -normal;
    Matrix3d own;
    own.col(2) = normal;
    own.col(0) = (frame.col(0) - frame.col(0).dot(normal) * normal).normalized();
    own.col(1) = normal.cross(own.col(0));
    one.points.assign(1, point);
    if (side == 0 || !own.allFinite() || !write_element(one, rest, own, thickness, values)) return false;
    values += one.values();
  }
  return true;
}

} // namespace

bool ElementLaw::write_unit(const Vec3* rest, double thickness, double* unit) const {
  const bool own_axes =
      shape_->dimension == 2 || (model() == ElasticModel::Corotational && rotation() == Rotation::Qr);
  const Eigen::Matrix3d frame = own_axes ? rest_frame(*shape_, rest) : Eigen::Matrix3d::Identity();
  for (int n = 0; n < first_point(); ++n) unit[n] = frame(n % 3, n / 3);
  double* points = unit + first_point();
  if (!write_element(*shape_, rest, frame, thickness, points)) return false;
  const bool by_point = rotates_per_point(shape_->dimension, static_cast<int>(shape_->points.size()));
  if (model() == ElasticModel::Corotational && by_point &&
      !write_in_tangent_planes(*shape_, rest, frame, thickness, points))
    return false;
  if (formulation() == Formulation::Enhanced)
    write_enhanced_modes(*shape_, rest, frame, material_, points, unit + first_mode());
  return true;
}

std::shared_ptr<const ElementLaw> element_law(ElementKind kind, ElasticModel model, Rotation rotation,
                                              const ElasticMaterial& material, Formulation formulation) {
  const ElementSettings settings{model, rotation, can_be_enhanced(kind) ? formulation : Formulation::Plain};
  const auto made = [&]<int N, int Dim, int Points>() -> std::shared_ptr<const ElementLaw> {
    return std::make_shared<ElementOf<N, Dim, Points>>(kind, settings, material);
  };
  switch (kind) {
  case ElementKind::Triangle:
    return made.template operator()<3, 2, 1>();
  case ElementKind::Quad:
    return made.template operator()<4, 2, 4>();
  case ElementKind::Tetrahedron:
    return made.template operator()<4, 3, 1>();
  case ElementKind::Hexahedron:
    return made.template operator()<8, 3, 8>();
  case ElementKind::Prism:
    return made.template operator()<6, 3, 6>();
  case ElementKind::Pyramid:
    return made.template operator()<5, 3, 4>();
  }
  return nullptr;
}

} // namespace rend
