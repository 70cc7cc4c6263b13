// Single distorted elements of every kind with their laws, and elastic bodies: for tests that compare with what
// is computed from the corners directly.
#pragma once

#include "sim/mechanics/elasticity.h"
#include "sim/mesh/bar.h"
#include "sim/random_meshes.h"
#include "sim/rows/frequency.h"

#include <Eigen/Geometry>

namespace rend::elements {

using meshes::Noise;

inline constexpr std::array<ElementKind, 6> every_kind{ElementKind::Triangle,    ElementKind::Quad,
                                                       ElementKind::Tetrahedron, ElementKind::Hexahedron,
                                                       ElementKind::Prism,       ElementKind::Pyramid};

inline std::vector<Vec3> regular(ElementKind kind) {
  switch (kind) {
  case ElementKind::Triangle:
    return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  case ElementKind::Quad:
    return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  case ElementKind::Tetrahedron:
    return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  case ElementKind::Hexahedron:
    return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  case ElementKind::Prism:
    return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  case ElementKind::Pyramid:
    return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
  }
  return {};
}

inline Eigen::Matrix3d random_rotation(Noise& noise) {
  return Eigen::Quaterniond(noise(), noise(), noise(), noise() + 0.1).normalized().toRotationMatrix();
}

// Corners displaced by up to `amount`, then rotated and translated at random. For a sheet, within its plane.
inline std::vector<Vec3> distorted(ElementKind kind, double amount, unsigned seed) {
  Noise noise(seed);
  std::vector<Vec3> corners = regular(kind);
  for (Vec3& x : corners) {
    Vec3 by = amount * noise.vector();
    if (shape_of(kind).dimension == 2) by.z() = 0;
    x += by;
  }
  const Eigen::Matrix3d R = random_rotation(noise);
  const Vec3 to = noise.vector();
  for (Vec3& x : corners) x = R * x + to;
  return corners;
}

struct Model {
  std::string name;
  ElasticModel model;
  Rotation rotation;
  Formulation formulation = Formulation::Plain;
};
inline const std::vector<Model>& every_model() {
  static const std::vector<Model> all{
      {"linear", ElasticModel::Linear, Rotation::Polar},
      {"qr", ElasticModel::Corotational, Rotation::Qr},
      {"polar", ElasticModel::Corotational, Rotation::Polar},
      {"enhanced linear", ElasticModel::Linear, Rotation::Polar, Formulation::Enhanced},
      {"enhanced qr", ElasticModel::Corotational, Rotation::Qr, Formulation::Enhanced},
      {"enhanced polar", ElasticModel::Corotational, Rotation::Polar, Formulation::Enhanced}};
  return all;
}

// A law and one element for it.
struct Element {
  std::vector<Vec3> rest, x, v;
  std::shared_ptr<const ElementLaw> law;
  std::vector<double> unit;

  Element(ElementKind kind, const Model& model, std::vector<Vec3> corners, double beta = 0,
          double poisson = 0.3)
      : rest(std::move(corners)), x(rest), v(rest.size(), Vec3::Zero()) {
    ElasticMaterial material = ElasticMaterial::of(100, poisson, shape_of(kind).dimension);
    material.damping = beta;
    law = element_law(kind, model.model, model.rotation, material, model.formulation);
    unit.resize(static_cast<std::size_t>(law->values()));
    if (!law->write_unit(rest.data(), 0.1, unit.data())) unit.clear();
  }
  std::size_t corners() const { return rest.size(); }
  UnitState state() const { return {x.data(), v.data(), rest.data()}; }
  std::vector<Vec3> forces() const {
    std::vector<Vec3> f(corners());
    law->forces(unit.data(), state(), f.data());
    return f;
  }
  double energy() const { return law->energy(unit.data(), state()); }
  void shake(double amount, unsigned seed) {
    Noise noise(seed);
    for (std::size_t n = 0; n < corners(); ++n) {
      x[n] += amount * noise.vector();
      v[n] = noise.vector();
    }
  }
  void turn(const Eigen::Matrix3d& R) {
    for (Vec3& p : x) p = R * p;
  }
};

// Calls f(element, name) for every kind and model.
template <class F> void for_each_element(double amount, double beta, F&& f) {
  unsigned seed = 1;
  for (ElementKind kind : every_kind)
    for (const Model& model : every_model())
      f(Element(kind, model, distorted(kind, amount, ++seed), beta), shape_of(kind).name + ", " + model.name);
}

inline double largest(const std::vector<Vec3>& vectors) {
  double most = 0;
  for (const Vec3& v : vectors) most = std::max(most, v.norm());
  return most;
}

// A bar whose inner and outer points are displaced by up to `amount` of a box.
inline CellMesh warped_bar(BarPattern pattern, int nx, int ny, int nz, double amount, unsigned seed) {
  CellMesh mesh = bar_cells({pattern, nx, ny, nz, Vec3(nx, ny, nz)});
  Noise noise(seed);
  for (Vec3& x : mesh.points) x += amount * noise.vector();
  return mesh;
}

// Each hexahedron as six pyramids around the mean of its corners.
inline CellMesh in_pyramids(CellMesh mesh) {
  CellMesh pyramids;
  pyramids.points = std::move(mesh.points);
  const CellShape& shape = shape_of(CellKind::Hexahedron);
  for (std::size_t cell = 0; cell < mesh.cells(); ++cell) {
    const auto corners = mesh.corners_of(cell);
    Vec3 sum = Vec3::Zero();
    for (std::uint32_t p : corners) sum += pyramids.points[p];
    const auto apex = static_cast<std::uint32_t>(pyramids.points.size());
    pyramids.points.push_back(sum / 8);
    for (const auto& ring : shape.ring) {
      const auto at = [&](std::size_t n) { return corners[static_cast<std::size_t>(ring[n])]; };
      pyramids.add(CellKind::Pyramid, {at(0), at(1), at(2), at(3), apex});
    }
  }
  return pyramids;
}

struct Elastic {
  std::string model = "corotational", rotation = "polar";
  double beta = 0;
  Cumulated cumulated = Cumulated::Auto;
  bool elementary = false;
  Formulation formulation = Formulation::Plain;
};

inline void add_elasticity(Body& body, const Elastic& recipe) {
  ElasticitySettings settings;
  settings.model = recipe.model == "linear"        ? ContinuumModel::Linear
                   : recipe.model == "mass-tensor" ? ContinuumModel::MassTensor
                                                   : ContinuumModel::Corotational;
  settings.rotation = recipe.rotation == "qr" ? Rotation::Qr : Rotation::Polar;
  settings.formulation = recipe.formulation;
  settings.young = 1000;
  if (body.map->dimension() == 2) settings.thickness = 0.1;
  settings.damping_stiffness = recipe.beta;
  for (auto& made : make_elasticity(*body.map, settings, body.notes))
    body.interactions.push_back(std::move(made));
}

inline std::unique_ptr<Body> elastic_body(std::unique_ptr<EmbeddedMap> map, const Elastic& recipe) {
  auto made = std::make_unique<Body>();
  made->map = std::move(map);
  CornerMass mass;
  mass.density = 10;
  made->mass = &made->map->add(mass.on(*made->map));
  add_elasticity(*made, recipe);
  ProgramOptions options;
  options.fold = recipe.cumulated != Cumulated::No;
  options.elementary = recipe.elementary;
  made->program = std::make_unique<Program>(*made->map, made->interactions, *made->mass, made->drag, options);
  return made;
}

struct NamedMap {
  std::string name;
  std::unique_ptr<EmbeddedMap> map;
};

// Irregular sheets and solids with every kind of element, and mixed ones.
inline std::vector<NamedMap> irregular_maps(double amount = 0.15) {
  std::vector<NamedMap> all;
  all.push_back({"hexahedra", solid_from(warped_bar(BarPattern::Hexahedra, 3, 2, 3, amount, 1))});
  all.push_back({"tetrahedra", solid_from(warped_bar(BarPattern::Tetrahedra, 3, 2, 2, 0.6 * amount, 2))});
  all.push_back({"prisms", solid_from(warped_bar(BarPattern::Prisms, 3, 2, 2, amount, 3))});
  all.push_back({"pyramids", solid_from(in_pyramids(warped_bar(BarPattern::Hexahedra, 2, 2, 1, amount, 8)))});
  all.push_back({"mixed", solid_from(warped_bar(BarPattern::Mixed, 6, 2, 2, 0.6 * amount, 4))});
  all.push_back(
      {"triangles", sheet_from(meshes::warped(meshes::sheet(SheetPattern::Triangles, 4, 4), amount, 5))});
  all.push_back({"quads", sheet_from(meshes::warped(meshes::sheet(SheetPattern::Quads, 5, 4), amount, 6))});
  all.push_back(
      {"mixed sheet", sheet_from(meshes::warped(meshes::sheet(SheetPattern::Mixed, 5, 4), amount, 7))});
  return all;
}

} // namespace rend::elements
