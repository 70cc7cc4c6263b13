// Forces and criteria computed from lists of polygons: no darts, no patterns, no folding. Slow and simple
// reference implementations for the program.
#pragma once

#include "sim/random_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace rend::meshes {

class BruteForce {
public:
  explicit BruteForce(const PolygonMesh& mesh) : mesh_(mesh), open_(mesh.corners.size(), false) {
    for (std::size_t s = 0; s < mesh.corners.size(); ++s) dart_.push_back(Dart{2 * s});
    find_edges();
  }

  // The polygons of a body that may be torn: points are vertex slots; open sides have no neighbour.
  explicit BruteForce(const EmbeddedMap& map) {
    for (const Record& rest : map.rest().values()) mesh_.points.push_back(rest.vec());
    mesh_.first.push_back(0);
    for_each_face(map, [&](Dart first) {
      Dart d = first;
      do {
        mesh_.corners.push_back(map.vertex(d));
        dart_.push_back(d);
        open_.push_back(map.map().is_free(2, d));
        d = map.map().alpha(1, map.map().alpha(0, d));
      } while (d != first);
      mesh_.first.push_back(static_cast<std::uint32_t>(mesh_.corners.size()));
    });
    find_edges();
  }

  // Positions and velocities by point, from a body's state.
  void look_at(const Body& body) {
    x_.assign(mesh_.points.size(), Vec3::Zero());
    v_ = x_;
    for (std::size_t s = 0; s < dart_.size(); ++s) {
      x_[mesh_.corners[s]] = body.map->position_of(dart_[s]);
      v_[mesh_.corners[s]] = body.map->velocity()[body.map->vertex(dart_[s])].vec();
    }
    force_.assign(mesh_.points.size(), Vec3::Zero());
    corner_.assign(dart_.size(), Vec3::Zero());
    singles_.clear();
  }

  // Adds the forces of an interaction, and counts its units and the pairs of particles that they connect.
  void add(const Spring& spring) {
    units_ = 0;
    pairs_.clear();
    if (spring.element == "stretch")
      stretch(spring);
    else if (spring.kind == "isotropic" || spring.kind == "anisotropic")
      shear(spring);
    else if (spring.kind == "provot")
      provot(spring);
    else
      angular(spring);
  }
  std::size_t units() const { return units_; }
  std::size_t pairs() const { return pairs_.size(); }

  // Elementary springs and hinges.
  struct Single {
    std::string element;   // "stretch", "shear", "bend"
    double force = 0;      // [N], magnitude; of a hinge its moment [N.m]
    double elongation = 0; // l/l0 − 1
    Dart on;               // some dart of its cell: edge, face, edge
    // point, and the force on it as a corner of one element [N]
    std::vector<std::pair<std::uint32_t, Vec3>> pulls;
  };
  const std::vector<Single>& singles() const { return singles_; }
  const std::vector<Dart>& darts() const { return dart_; } // of each corner
  std::size_t corner_at(std::uint32_t point) const {       // one of the corners there
    return static_cast<std::size_t>(std::find(mesh_.corners.begin(), mesh_.corners.end(), point) -
                                    mesh_.corners.begin());
  }

  // In the order of the body's slots.
  std::vector<Record> forces(const Body& body) const {
    std::vector<Record> out(body.program->vertices());
    for (std::size_t s = 0; s < dart_.size(); ++s)
      out[body.map->vertex(dart_[s])] = Record(force_[mesh_.corners[s]]);
    return out;
  }
  std::vector<Record> corner_forces(const Body& body) const {
    const CellIndex& corners = body.map->cells(VertexOfFace);
    std::vector<Record> out(corners.slots());
    for (std::size_t s = 0; s < dart_.size(); ++s) out[corners.slot(dart_[s])] = Record(corner_[s]);
    return out;
  }

  // Values of the criteria at every edge between two polygons, by the smallest dart of the edge (thesis
  // 7.4.1, 7.4.3).
  std::map<Dart, double> border_values(const EmbeddedMap& map, bool atomic) const {
    std::map<Dart, double> values;
    for (const Edge& e : edges_) {
      const Vec3 f = atomic ? Vec3((corner_[e.p.a] + corner_[e.p.b]) - (corner_[e.q.a] + corner_[e.q.b]))
                            : Vec3(force_[e.a] + force_[e.b]);
      Vec3 n1 = normal(e.p.polygon), n2 = normal(e.q.polygon);
      // both traverse their common edge in the same direction: one is flipped
      if (e.p.forward == e.q.forward) n2 = -n2;
      const Vec3 sum = (n1 + n2).norm() < 1e-12 ? n1 : Vec3(n1 + n2);
      const Vec3 across = (x_[e.b] - x_[e.a]).cross(sum);
      const Dart d = dart_[side(e)];
      const std::vector<Dart> darts{d, map.map().alpha(0, d), map.map().alpha(2, d),
                                    map.map().follow(d, Word("02"))};
      values[*std::min_element(darts.begin(), darts.end())] = std::abs(f.dot(across.normalized()));
    }
    return values;
  }

private:
  struct Flank { // an edge as a side of one of its polygons; corners are indices into the list of all corners
    std::size_t polygon = 0;
    std::size_t a = 0, b = 0;           // at the edge's ends
    std::size_t near_a = 0, near_b = 0; // their other neighbours in the polygon
    bool forward = true;                // traversed from a to b
  };
  struct Edge {
    std::uint32_t a, b; // points
    Flank p, q;
  };

  static std::size_t side(const Edge& e) { return e.p.forward ? e.p.a : e.p.b; } // the corner where it starts

  std::size_t sides(std::size_t polygon) const { return mesh_.first[polygon + 1] - mesh_.first[polygon]; }
  std::size_t corner(std::size_t polygon, std::size_t n) const {
    return mesh_.first[polygon] + n % sides(polygon);
  }

  void find_edges() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Flank>> flanks;
    for (std::size_t p = 0; p < mesh_.polygons(); ++p) {
      const std::size_t n = sides(p);
      for (std::size_t i = 0; i < n; ++i) {
        if (open_[corner(p, i)]) continue;
        Flank f{p, corner(p, i), corner(p, i + 1), corner(p, i + n - 1), corner(p, i + 2), true};
        std::uint32_t a = mesh_.corners[f.a], b = mesh_.corners[f.b];
        if (a > b) {
          std::swap(a, b);
          std::swap(f.a, f.b);
          std::swap(f.near_a, f.near_b);
          f.forward = false;
        }
        flanks[{a, b}].push_back(f);
      }
    }
    for (const auto& [ends, list] : flanks)
      if (list.size() == 2) edges_.push_back({ends.first, ends.second, list[0], list[1]});
  }

  Vec3 at(std::size_t corner) const { return x_[mesh_.corners[corner]]; }
  Vec3 speed(std::size_t corner) const { return v_[mesh_.corners[corner]]; }
  Vec3 rest(std::size_t corner) const { return mesh_.points[mesh_.corners[corner]]; }

  void push(std::size_t corner, const Vec3& f) {
    force_[mesh_.corners[corner]] += f;
    corner_[corner] += f;
  }

  void spring(std::size_t i, std::size_t j, const Spring& s, std::size_t on) {
    const Vec3 d = at(j) - at(i);
    const double length = d.norm(), rest_length = (rest(j) - rest(i)).norm();
    const double tension = s.k * (length - rest_length) + s.damping * (speed(j) - speed(i)).dot(d) / length;
    push(i, tension / length * d);
    push(j, -tension / length * d);
    singles_.push_back({s.element,
                        std::abs(tension),
                        length / rest_length - 1,
                        dart_[on],
                        {{mesh_.corners[i], tension / length * d}, {mesh_.corners[j], -tension / length * d}}});
    ++units_;
    pairs_.insert(std::minmax(mesh_.corners[i], mesh_.corners[j]));
  }

  void stretch(const Spring& s) {
    for (std::size_t p = 0; p < mesh_.polygons(); ++p)
      for (std::size_t i = 0; i < sides(p); ++i) spring(corner(p, i), corner(p, i + 1), s, corner(p, i));
  }

  void shear(const Spring& s) {
    for (std::size_t p = 0; p < mesh_.polygons(); ++p) {
      const std::size_t n = sides(p);
      if (n == 4) {
        spring(corner(p, 0), corner(p, 2), s, corner(p, 0));
        spring(corner(p, 1), corner(p, 3), s, corner(p, 0));
      } else if (n > 4 && s.kind == "anisotropic") {
        for (std::size_t i = 0; i < n; ++i) spring(corner(p, i + n - 1), corner(p, i + 1), s, corner(p, 0));
      }
    }
  }

  void provot(const Spring& s) {
    for (const Edge& e : edges_) {
      spring(e.p.near_a, e.q.near_a, s, side(e));
      spring(e.p.near_b, e.q.near_b, s, side(e));
    }
  }

  template <class Place> Vec3 centre(const Flank& f, Place&& place) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t n = 0; n < sides(f.polygon); ++n) sum += place(corner(f.polygon, n));
    return sum / static_cast<double>(sides(f.polygon));
  }

  // The dihedral angle from the directions from the hinge into the two faces: π minus the angle between them.
  template <class Place> double dihedral(const Edge& e, Place&& place) const {
    const Vec3 a = place(e.p.a), u = (place(e.p.b) - a).normalized();
    const auto into = [&](const Flank& f) {
      const Vec3 arm = centre(f, place) - a;
      return Vec3(arm - arm.dot(u) * u).normalized();
    };
    const Vec3 p = into(e.p), q = into(e.q);
    const double between = 2 * std::atan2((p - q).norm(), (p + q).norm());
    return (q.dot(u.cross(p)) > 0 ? -1 : 1) * (pi_ - between);
  }

  // The factor on a hinge's forces if the area of a triangle (hinge, face centre) is less than 1/8 of the
  // smaller one's at rest, by the squares of areas.
  double crushed(const Edge& e) const {
    const auto area = [&](const Flank& f, auto&& place) {
      const Vec3 a = place(e.p.a);
      return (place(e.p.b) - a).cross(0.5 * (place(f.near_a) + place(f.near_b)) - a).norm();
    };
    const auto now = [&](std::size_t c) { return at(c); };
    const auto once = [&](std::size_t c) { return rest(c); };
    const double least = std::min(area(e.p, once), area(e.q, once)) / 8;
    const double p = std::min(1.0, area(e.p, now) / least), q = std::min(1.0, area(e.q, now) / least);
    return p * p * q * q;
  }

  void angular(const Spring& s) {
    for (const Edge& e : edges_) {
      if (sides(e.p.polygon) > 4 || sides(e.q.polygon) > 4) continue;
      ++units_;
      double turn = dihedral(e, [&](std::size_t c) { return at(c); }) -
                    dihedral(e, [&](std::size_t c) { return rest(c); });
      turn -= 2 * pi_ * std::round(turn / (2 * pi_));
      const Vec3 a = at(e.p.a), ab = at(e.p.b) - a, u = ab.normalized();
      std::vector<std::pair<std::size_t, Vec3>> pulls; // corner, ∂θ/∂x
      for (const Flank& f : {e.p, e.q}) {
        // Both outer vertices have half the gradient of the midpoint between them.
        const Vec3 between = 0.5 * (at(f.near_a) + at(f.near_b)) - a, across = u.cross(between);
        const Vec3 g = (f.polygon == e.p.polygon ? -1 : 1) / across.norm() * across.normalized();
        const double t = between.dot(u) / ab.norm();
        pulls.push_back({f.near_a, 0.5 * g});
        pulls.push_back({f.near_b, 0.5 * g});
        pulls.push_back({f.a, -(1 - t) * g});
        pulls.push_back({f.b, -t * g});
      }
      const double fade = crushed(e);
      for (auto& [c, g] : pulls) g *= fade;
      double moment = s.k * turn;
      for (const auto& [c, g] : pulls) moment += s.damping * g.dot(speed(c));
      for (const auto& [c, g] : pulls) push(c, -moment * g);
      Single single{s.element, std::abs(fade * moment), 0, dart_[side(e)], {}};
      std::map<std::size_t, Vec3> on_corner; // the outer vertex of a triangle is a neighbour of both ends
      for (const auto& [c, g] : pulls) on_corner.try_emplace(c, Vec3::Zero()).first->second -= moment * g;
      for (const auto& [c, f] : on_corner) single.pulls.push_back({mesh_.corners[c], f});
      singles_.push_back(std::move(single));
    }
  }

  Vec3 normal(std::size_t polygon) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t n = 0; n < sides(polygon); ++n)
      sum += at(corner(polygon, n)).cross(at(corner(polygon, n + 1)));
    return sum.normalized();
  }

  static constexpr double pi_ = 3.14159265358979323846;

  PolygonMesh mesh_;       // points at rest
  std::vector<Dart> dart_; // of each corner, along the side that starts there
  std::vector<bool> open_; // whether that side is open
  std::vector<Edge> edges_;
  std::vector<Vec3> x_, v_, force_; // by point
  std::vector<Vec3> corner_;        // force, by corner
  std::vector<Single> singles_;
  std::size_t units_ = 0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs_;
};

} // namespace rend::meshes
