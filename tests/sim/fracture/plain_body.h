// Reference values of criteria, computed from lists of polyhedra (for a sheet: polygons) by the definitions
// (thesis 7.4; sim/README.md, "Tearing"): no rows, no folding, no early rejection.
#pragma once

#include "sim/elements.h"
#include "sim/topology/walk.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <map>
#include <set>

namespace rend::plain {

struct Measured {
  double value = 0;
  Vec3 normal = Vec3::Zero();
};
using Values = std::map<Dart, Measured>; // by the smallest dart of the cell

struct Polygon {
  std::vector<Dart> dart; // of each corner, along the side that starts there
  std::vector<Slot> vertex;
};
struct Polyhedron { // for a sheet, with one face
  std::vector<Polygon> faces;
  Dart first;
};

inline std::vector<Polyhedron> polyhedra(const EmbeddedMap& map) {
  std::vector<Polyhedron> all;
  std::set<Dart> seen;
  map.map().for_each_dart([&](Dart first) {
    if (seen.contains(first)) return;
    Polyhedron p{{}, first};
    for (Dart d : darts_of(map.map(), element_orbit(map.dimension()), first)) {
      if (seen.contains(d)) continue;
      Polygon face;
      Dart at = d;
      do {
        face.dart.push_back(at);
        face.vertex.push_back(map.vertex(at));
        const Dart end = map.map().alpha(0, at);
        seen.insert(at);
        seen.insert(end);
        at = map.map().alpha(1, end);
      } while (at != d);
      p.faces.push_back(face);
    }
    all.push_back(p);
  });
  return all;
}

inline Measured largest_of(const Eigen::Matrix3d& tensor, bool compression) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor);
  const Vec3 e = solver.eigenvalues();
  if (compression && -e[0] > e[2]) return {-e[0], solver.eigenvectors().col(0)};
  return {e[2], solver.eigenvectors().col(2)};
}

class PlainBody {
public:
  explicit PlainBody(const Body& body) : map_(*body.map), elements_(polyhedra(map_)) {
    force_.assign(map_.cells(Vertex).slots(), Vec3::Zero());
  }

  void add_springs(const meshes::Spring& s, bool in_volume = false) {
    for (const Polyhedron& p : elements_) {
      if (in_volume) add_volume_diagonals(p, s);
      for (const Polygon& face : p.faces) {
        const std::size_t n = face.vertex.size();
        if (in_volume) continue;
        for (std::size_t i = 0; s.element == "stretch" && i < n; ++i)
          add(p, face.vertex[i], face.vertex[(i + 1) % n], s, smallest_dart(map_.map(), Edge, face.dart[i]));
        for (std::size_t i = 0; s.element == "shear" && n == 4 && i < 2; ++i)
          add(p, face.vertex[i], face.vertex[i + 2], s, p.first);
      }
    }
  }

  // `mass`: that of the corners, which changes may have passed on; null: as of one density.
  void add_elements(ElasticModel model, Rotation rotation, const ElasticMaterial& material, double thickness,
                    const MassColumn* mass = nullptr) {
    for (const Polyhedron& p : elements_) {
      const auto at = element_at(map_.map(), p.first);
      if (!at) continue;
      const auto law = element_law(at->kind, model, rotation, material);
      std::vector<Vec3> rest, x, v, f(8);
      std::vector<Dart> corner;
      for (const Word& word : law->shape().units[at->unit]) {
        corner.push_back(map_.map().follow(p.first, word));
        rest.push_back(map_.rest_of(corner.back()));
        x.push_back(map_.position_of(corner.back()));
        v.push_back(map_.velocity()[map_.vertex(corner.back())].vec());
      }
      std::vector<double> unit(static_cast<std::size_t>(law->values()));
      EXPECT_TRUE(law->write_unit(rest.data(), thickness, unit.data()));
      const UnitState state{x.data(), v.data(), rest.data()};
      law->forces(unit.data(), state, f.data());
      stress_[p.first] = law->stress(unit.data(), state);
      strain_[p.first] = law->strain(unit.data(), state);
      for (std::size_t n = 0; n < corner.size(); ++n) {
        push(p, map_.vertex(corner[n]), f[n]);
        const double size =
            mass ? (*mass)[map_.slot(mass->orbit(), corner[n])] * static_cast<double>(corner.size())
                 : extent(p);
        at_vertex_[map_.vertex(corner[n])].push_back({size, p.first});
      }
    }
  }

  Values values(const std::string& criterion, const std::string& kind, bool compression) const {
    if (criterion == "atomic-spring" || (criterion == "strain" && !kind.empty()))
      return spring_values(kind, criterion == "strain", compression);
    Values all;
    if (criterion == "atomic-element")
      for (const auto& [d, sigma] : stress_) all[d] = {largest_of(sigma, compression).value, Vec3::Zero()};
    if (criterion == "strain")
      for (const auto& [d, epsilon] : strain_) all[d] = {largest_of(epsilon, compression).value, Vec3::Zero()};
    if (criterion.ends_with("border")) return border_values(criterion == "atomic-border");
    const CellIndex& vertices = map_.cells(Vertex);
    for (Slot s = 0; s < vertices.slots(); ++s) {
      if (!vertices.alive(s)) continue;
      const Dart d = vertices.first_dart(s);
      if (criterion == "cumulative-vertex") all[d] = {force_[s].norm(), force_[s].normalized()};
      if (criterion == "atomic-vertex" && singles_at_.contains(s))
        all[d] = {singles_at_.at(s).norm(), singles_at_.at(s).normalized()};
      if (criterion == "vertex-stress" && at_vertex_.contains(s)) all[d] = mean_at(s, stress_, compression);
      if (criterion == "vertex-strain" && at_vertex_.contains(s)) all[d] = mean_at(s, strain_, compression);
    }
    return all;
  }

private:
  struct Single {
    std::string kind;
    double force, elongation;
    Dart cell;
  };

  void add(const Polyhedron& p, Slot i, Slot j, const meshes::Spring& s, Dart cell) {
    const Vec3 d = map_.position()[j].vec() - map_.position()[i].vec();
    const Vec3 w = map_.velocity()[j].vec() - map_.velocity()[i].vec();
    const double length = d.norm(), rest = (map_.rest()[j].vec() - map_.rest()[i].vec()).norm();
    const double tension = s.k * (length - rest) + s.damping * w.dot(d) / length;
    singles_.push_back({s.element, std::abs(tension), length / rest - 1, cell});
    push(p, i, tension / length * d);
    push(p, j, -tension / length * d);
  }

  void add_volume_diagonals(const Polyhedron& p, const meshes::Spring& s) {
    if (p.faces.size() != 6 || p.faces[0].vertex.size() != 4) return;
    std::map<Slot, std::set<Slot>> near; // vertices that share a face
    for (const Polygon& face : p.faces)
      for (Slot a : face.vertex)
        for (Slot b : face.vertex) near[a].insert(b);
    for (const auto& [a, others] : near)
      for (const auto& [b, unused] : near)
        if (a < b && !others.contains(b)) add(p, a, b, s, p.first);
  }

  void push(const Polyhedron& p, Slot v, const Vec3& f) {
    force_[v] += f;
    corner_.try_emplace({p.first, v}, Vec3::Zero()).first->second += f;
    Vec3& most = singles_at_.try_emplace(v, Vec3::Zero()).first->second;
    if (f.norm() > most.norm()) most = f;
  }

  Values spring_values(const std::string& kind, bool elongation, bool compression) const {
    Values all;
    for (const Single& s : singles_) {
      if (s.kind != kind) continue;
      const double value = !elongation ? s.force : compression ? std::abs(s.elongation) : s.elongation;
      double& most = all.try_emplace(s.cell, Measured{-1, Vec3::Zero()}).first->second.value;
      most = std::max(most, value);
    }
    return all;
  }

  Values border_values(bool atomic) const {
    Values all;
    for (const Polyhedron& p : elements_) {
      for (const Polygon& face : p.faces) {
        if (map_.map().is_free(3, face.dart[0])) continue;
        const Dart other = smallest_dart(map_.map(), Volume, map_.map().alpha(3, face.dart[0]));
        Vec3 sum = Vec3::Zero(), normal = Vec3::Zero();
        for (std::size_t n = 0; n < face.vertex.size(); ++n) {
          const Slot v = face.vertex[n], next = face.vertex[(n + 1) % face.vertex.size()];
          normal += map_.position()[v].vec().cross(map_.position()[next].vec());
          sum += atomic ? Vec3(at_corner(p.first, v) - at_corner(other, v)) : force_[v];
        }
        all[smallest_dart(map_.map(), Face, face.dart[0])] = {std::abs(sum.dot(normal.normalized())),
                                                              Vec3::Zero()};
      }
    }
    return all;
  }

  Vec3 at_corner(Dart element, Slot v) const {
    const auto at = corner_.find({element, v});
    return at == corner_.end() ? Vec3(Vec3::Zero()) : at->second;
  }

  // Volume [m³] or area [m²] at rest, proportional to mass, since a body has one density. Each face is split
  // into triangles from the mean of its corners, and the volume into tetrahedra from these to its centre.
  double extent(const Polyhedron& p) const {
    const auto mean = [&](const std::vector<Slot>& of) {
      Vec3 sum = Vec3::Zero();
      for (Slot v : of) sum += map_.rest()[v].vec();
      return Vec3(sum / static_cast<double>(of.size()));
    };
    std::vector<Slot> all;
    for (const Polygon& face : p.faces) all.insert(all.end(), face.vertex.begin(), face.vertex.end());
    const Vec3 middle = mean(all);
    double sum = 0;
    for (const Polygon& face : p.faces) {
      const Vec3 c = mean(face.vertex);
      for (std::size_t n = 0; n < face.vertex.size(); ++n) {
        const Vec3 a = map_.rest()[face.vertex[n]].vec() - c;
        const Vec3 twice = a.cross(map_.rest()[face.vertex[(n + 1) % face.vertex.size()]].vec() - c);
        sum += p.faces.size() == 1 ? twice.norm() / 2 : std::abs(twice.dot(middle - c)) / 6;
      }
    }
    return sum;
  }

  // Σ m σ / Σ m over the elements (e) around the vertex (thesis 7.2); the same of ε, which no criterion
  // measures.
  Measured mean_at(Slot v, const std::map<Dart, Eigen::Matrix3d>& tensors, bool compression) const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    double whole = 0;
    for (const auto& [m, element] : at_vertex_.at(v)) {
      sum += m * tensors.at(element);
      whole += m;
    }
    return largest_of(sum / whole, compression);
  }

  const EmbeddedMap& map_;
  std::vector<Polyhedron> elements_;
  std::vector<Vec3> force_;                      // [N], by vertex
  std::map<std::pair<Dart, Slot>, Vec3> corner_; // [N], by element and vertex
  std::map<Slot, Vec3> singles_at_;              // largest force of a single element [N]
  std::vector<Single> singles_;
  std::map<Dart, Eigen::Matrix3d> stress_, strain_;                // by element
  std::map<Slot, std::vector<std::pair<double, Dart>>> at_vertex_; // extents or masses, and elements
};

} // namespace rend::plain
