#include "sim/scene/measure.h"

#include "sim/mechanics/mass_tensor.h"
#include "sim/mechanics/spring_law.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

// The largest of value(k, rest length, length) over the springs at each vertex.
template <class F> std::vector<double> largest_of_springs(const Body& body, F&& value) {
  std::vector<double> out(body.program->vertices(), 0);
  const auto& x = body.map->position().values();
  for (const Binder& binder : body.program->rows()) {
    if (binder.interaction()->law != spring_law()) continue;
    const PackedRows& rows = binder.rows();
    rows.for_each([&](std::size_t, std::size_t row) {
      const std::uint32_t i = rows.index(0)[row], j = rows.index(1)[row];
      const double here = value(rows.value(0, row), rows.value(2, row), (x[j].vec() - x[i].vec()).norm());
      out[i] = std::max(out[i], here);
      out[j] = std::max(out[j], here);
    });
  }
  return out;
}

// An element in its current state, without velocities.
struct ElementNow {
  const ElementLaw* law;
  const double* unit;
  std::array<Dart, most_particles> corner{};
  std::array<Vec3, most_particles> position, velocity, rest;

  int corners() const { return law->particles(); }
  UnitState state() const { return {position.data(), velocity.data(), rest.data()}; }

  ElementNow(const EmbeddedMap& map, const ElementLaw& law_, const double* unit_, Dart d, std::size_t words)
      : law(&law_), unit(unit_) {
    velocity.fill(Vec3::Zero());
    for (std::size_t n = 0; n < static_cast<std::size_t>(corners()); ++n) {
      corner[n] = map.map().follow(d, law_.shape().units[words][n]);
      position[n] = map.position_of(corner[n]);
      rest[n] = map.rest_of(corner[n]);
    }
  }
};

// The linear elements that mass-tensors were made of.
template <class F> void each_tensor_element(const EmbeddedMap& map, const MassTensorRequest& request, F&& f) {
  std::array<std::shared_ptr<const ElementLaw>, element_kinds> laws;
  std::vector<double> unit;
  const CellIndex& elements = map.cells(element_orbit(map.dimension()));
  for (Slot e = 0; e < elements.slots(); ++e) {
    const auto at = elements.alive(e) ? element_at(map.map(), elements.first_dart(e)) : std::nullopt;
    if (!at) continue;
    auto& law = laws[static_cast<std::size_t>(at->kind)];
    if (!law) law = element_law(at->kind, ElasticModel::Linear, Rotation::Polar, request.material);
    unit.resize(static_cast<std::size_t>(law->values()));
    ElementNow now(map, *law, unit.data(), elements.first_dart(e), at->unit);
    if (law->write_unit(now.rest.data(), request.thickness, unit.data())) f(now);
  }
}

// Calls f(ElementNow) for every element of a continuum.
template <class F> void each_element(const Body& body, F&& f) {
  const EmbeddedMap& map = *body.map;
  for (const auto& interaction : body.interactions) {
    const auto* tensors = dynamic_cast<const MassTensorLaw*>(interaction->law.get());
    if (tensors && tensors->particles() == 1) each_tensor_element(map, tensors->request(), f);
    const auto* law = dynamic_cast<const ElementLaw*>(interaction->law.get());
    if (!law) continue;
    const CellIndex& owners = map.cells(interaction->pattern.owner);
    for (Slot e = 0; e < owners.slots(); ++e) {
      const auto at = owners.alive(e) ? element_at(map.map(), owners.first_dart(e)) : std::nullopt;
      if (at && at->kind == law->shape().kind)
        f(ElementNow(map, *law, interaction->unit(e, at->unit), owners.first_dart(e), at->unit));
    }
  }
}

Vec3 principal(const Eigen::Matrix3d& tensor) { // ascending
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, Eigen::EigenvaluesOnly).eigenvalues();
}

} // namespace

std::vector<double> vertex_strain(const Body& body) {
  std::vector<double> out = largest_of_springs(
      body, [](double, double rest, double length) { return rest > 0 ? std::abs(length / rest - 1) : 0; });
  each_element(body, [&](const ElementNow& e) {
    const double here = principal(e.law->strain(e.unit, e.state())).cwiseAbs().maxCoeff();
    for (int n = 0; n < e.corners(); ++n) {
      double& most = out[body.map->vertex(e.corner[static_cast<std::size_t>(n)])];
      most = std::max(most, here);
    }
  });
  return out;
}

std::vector<double> vertex_force(const Body& body) {
  std::vector<double> out = largest_of_springs(
      body, [](double k, double rest, double length) { return k * std::abs(length - rest); });
  std::array<Vec3, most_particles> force;
  each_element(body, [&](const ElementNow& e) {
    e.law->forces(e.unit, e.state(), force.data());
    for (std::size_t n = 0; n < static_cast<std::size_t>(e.corners()); ++n) {
      double& most = out[body.map->vertex(e.corner[n])];
      most = std::max(most, force[n].norm());
    }
  });
  return out;
}

std::vector<double> vertex_stress(const Body& body) {
  const std::size_t count = body.program->vertices();
  std::vector<Eigen::Matrix3d> sum(count, Eigen::Matrix3d::Zero()); // Σ m σ [kg·Pa]
  std::vector<double> mass(count, 0), out(count, 0);
  each_element(body, [&](const ElementNow& e) {
    const Eigen::Matrix3d stress = e.law->stress(e.unit, e.state());
    for (int n = 0; n < e.corners(); ++n) {
      const Dart corner = e.corner[static_cast<std::size_t>(n)];
      const double m = (*body.mass)[body.map->slot(body.mass->orbit(), corner)];
      sum[body.map->vertex(corner)] += m * stress;
      mass[body.map->vertex(corner)] += m;
    }
  });
  for (std::size_t v = 0; v < count; ++v)
    if (mass[v] > 0) out[v] = std::max(0.0, principal(sum[v] / mass[v])[2]);
  return out;
}

} // namespace rend
