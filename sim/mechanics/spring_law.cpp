#include "sim/mechanics/spring_law.h"

#include <algorithm>
#include <cmath>

namespace rend {

Vec3 spring_force(const UnitParameters& p, const Vec3& xi, const Vec3& xj, const Vec3& vi, const Vec3& vj) {
  const Vec3 d = xj - xi;
  const double length = std::sqrt(d.x() * d.x() + d.y() * d.y() + d.z() * d.z());
  if (length == 0) return Vec3::Zero();
  const Vec3 u = d / length;
  return (p.k * (length - p.rest) + p.damping * (vj - vi).dot(u)) * u;
}

double spring_energy(const UnitParameters& p, const Vec3& xi, const Vec3& xj) {
  const double stretch = (xj - xi).norm() - p.rest;
  return 0.5 * p.k * stretch * stretch;
}

namespace {

// Writes a block for both particles and its negative between them.
void spread(const Eigen::Matrix3d& block, UnitMatrix& matrix) {
  matrix.resize(6, 6);
  matrix.topLeftCorner<3, 3>() = matrix.bottomRightCorner<3, 3>() = block;
  matrix.topRightCorner<3, 3>() = matrix.bottomLeftCorner<3, 3>() = -block;
}

class SpringLaw final : public ForceLaw {
public:
  SpringLaw() : ForceLaw("spring", 2, 3, 1) {}

  void forces(const double* unit, const UnitState& s, Vec3* force) const override {
    force[0] =
        spring_force(UnitParameters::of(unit), s.position[0], s.position[1], s.velocity[0], s.velocity[1]);
    force[1] = -force[0];
  }

  double energy(const double* unit, const UnitState& s) const override {
    return spring_energy(UnitParameters::of(unit), s.position[0], s.position[1]);
  }

  void stiffness(const double* unit, const UnitState& s, Tangent tangent, UnitMatrix& by_position,
                 UnitMatrix& by_velocity) const override {
    const UnitParameters p = UnitParameters::of(unit);
    const Vec3 d = s.position[1] - s.position[0];
    const double length = d.norm();
    Eigen::Matrix3d along = Eigen::Matrix3d::Zero(), whole = along;
    if (length > 0) {
      along = d * d.transpose() / (length * length);
      double sideways = 1 - p.rest / length;
      if (tangent != Tangent::Exact) sideways = std::max(0.0, sideways);
      whole = p.k * (sideways * (Eigen::Matrix3d::Identity() - along) + along);
      const Vec3 w = s.velocity[1] - s.velocity[0]; // the derivative of the damping force by position
      if (tangent == Tangent::Exact && p.damping > 0)
        whole += p.damping / length *
                 (along * w.dot(d) / length * -2 + d * w.transpose() / length +
                  w.dot(d) / length * Eigen::Matrix3d::Identity());
    }
    spread(whole, by_position);
    spread(p.damping * along, by_velocity);
  }

  void bound(const double* unit, const Vec3*, const double*, double* stiffness,
             double* damping) const override {
    const UnitParameters p = UnitParameters::of(unit);
    stiffness[0] = stiffness[1] = 2 * p.k;
    damping[0] = damping[1] = 2 * p.damping;
  }

  bool acts(const double* unit, const std::uint32_t* vertex) const override {
    return vertex[0] != vertex[1] && (unit[0] != 0 || unit[1] != 0);
  }

  void fold(double* sum, const double* other, bool) const override { // both have the same rest length
    sum[0] += other[0];
    sum[1] += other[1];
  }
};

} // namespace

const std::shared_ptr<const ForceLaw>& spring_law() {
  static const std::shared_ptr<const ForceLaw> law = std::make_shared<SpringLaw>();
  return law;
}

} // namespace rend
