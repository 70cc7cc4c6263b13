// Interactions of tests whose owner is a vertex, which none of the shipped ones has.
#pragma once

#include "sim/mechanics/interaction.h"
#include "sim/mechanics/spring_law.h"

#include <memory>

namespace rend::ground {

// f = −k (x − X) − c v, along the given axes alone.
class GroundLaw final : public ForceLaw {
public:
  explicit GroundLaw(const Vec3& axes) : ForceLaw("ground", 1, 3, 1), axes_(axes) {}

  void forces(const double* unit, const UnitState& s, Vec3* force) const override {
    const Vec3 pull = unit[0] * (s.position[0] - s.rest[0]) + unit[1] * s.velocity[0];
    force[0] = -axes_.cwiseProduct(pull);
  }
  double energy(const double* unit, const UnitState& s) const override {
    return 0.5 * unit[0] * axes_.cwiseProduct(s.position[0] - s.rest[0]).squaredNorm();
  }
  void stiffness(const double* unit, const UnitState&, Tangent, UnitMatrix& by_position,
                 UnitMatrix& by_velocity) const override {
    by_position = Eigen::Matrix3d(unit[0] * axes_.asDiagonal());
    by_velocity = Eigen::Matrix3d(unit[1] * axes_.asDiagonal());
  }
  void bound(const double* unit, const Vec3*, const double*, double* stiffness,
             double* damping) const override {
    stiffness[0] = unit[0];
    damping[0] = unit[1];
  }
  bool acts(const double* unit, const std::uint32_t*) const override { return unit[0] > 0; }

private:
  Vec3 axes_; // 1: it acts along that axis; 0: not
};

inline bool always(const GMap&, Dart, std::size_t) {
  return true;
}

// k [N/m] at every vertex, whatever its mass.
inline std::unique_ptr<Interaction> springs(EmbeddedMap& map, double k, double damping = 0,
                                            const Vec3& axes = Vec3::Ones()) {
  const Pattern pattern{
      .owner = Vertex, .support = SingleDart, .units = {{""}}, .fold = {}, .present = &always};
  return make_interaction<1>(map, "ground", std::make_shared<GroundLaw>(axes), pattern, damping,
                             [=](const EmbeddedMap&, Dart, int) {
                               return UnitParameters{k, damping, 0};
                             });
}

// A spring from every vertex to the other end of its smallest dart's edge.
inline std::unique_ptr<Interaction> springs_to_neighbours(EmbeddedMap& map, double k, double damping = 0) {
  const Pattern pattern{
      .owner = Vertex, .support = SingleDart, .units = {{"", "0"}}, .fold = {}, .present = &always};
  return make_interaction<1>(map, "neighbour", spring_law(), pattern, damping,
                             [=](const EmbeddedMap& body, Dart d, int) {
                               const Dart e = body.map().alpha(0, d);
                               return UnitParameters{k, damping, (body.rest_of(e) - body.rest_of(d)).norm()};
                             });
}

} // namespace rend::ground
