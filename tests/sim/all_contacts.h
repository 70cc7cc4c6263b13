// Contact of sheets and of fragments of solids a second time, for tests: all pairs of vertices and faces, edges
// and edges, edges and faces of a step, one by one, by what the headers of sim/contact say of a pair. Without
// lists, trees or code in common.
#pragma once

#include "sim/contact/contact_fragments.h"
#include "sim/heaps.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <vector>

namespace rend::all_contacts {

using Name = std::array<std::size_t, 6>; // of a pair of edges: body and ends of each

// By what connects faces: the smallest vertex of each vertex's fragment.
inline std::vector<Slot> fragments_of(std::size_t vertices, const ContactFaces& faces) {
  std::vector<Slot> label(vertices);
  for (Slot v = 0; v < label.size(); ++v) label[v] = v;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& face : faces.triangles())
      for (const Slot v : face.vertex)
        for (const Slot w : face.vertex)
          if (label[w] < label[v]) label[v] = label[w], changed = true;
  }
  return label;
}

// A body in a step.
struct Matter {
  std::vector<Vec3> from, to, rest; // [m]
  std::vector<Slot> fragment;       // of each vertex
  std::vector<std::array<Slot, 3>> faces;
  std::set<std::array<Slot, 2>> edges;
  std::set<Slot> vertices; // of faces
  bool solid = false, self = false;
  double thickness = 0; // [m]
};

inline Matter matter_of(const ContactBody& body) {
  Matter of;
  for (Slot v = 0; v < body.vertices(); ++v) {
    of.from.push_back(body.from(v));
    of.to.push_back(body.position(v));
    of.rest.push_back(body.body->map->rest()[v]);
  }
  of.fragment = fragments_of(body.vertices(), *body.faces);
  for (const auto& face : body.faces->triangles()) {
    of.faces.push_back(face.vertex);
    for (std::size_t k = 0; k < 3; ++k) {
      const Slot a = face.vertex[k], b = face.vertex[(k + 1) % 3];
      of.edges.insert({std::min(a, b), std::max(a, b)});
      of.vertices.insert(a);
    }
  }
  of.solid = body.solid();
  of.self = body.settings().self;
  of.thickness = body.settings().thickness;
  return of;
}

// The nearest point of a triangle: that of its plane, or of a side.
inline Vec3 nearest_of(const TriangleCorners& y, const Vec3& x, bool& over) {
  const Vec3 n = (y[1] - y[0]).cross(y[2] - y[0]).normalized();
  Vec3 best = x - n.dot(x - y[0]) * n;
  over = true;
  for (std::size_t k = 0; k < 3; ++k) over = over && n.dot((y[(k + 1) % 3] - y[k]).cross(x - y[k])) > 0;
  double least = 1e300;
  for (std::size_t k = 0; k < 3 && !over; ++k) {
    const Vec3 way = y[(k + 1) % 3] - y[k];
    const Vec3 at = y[k] + std::clamp((x - y[k]).dot(way) / way.dot(way), 0.0, 1.0) * way;
    if ((x - at).norm() < least) least = (x - at).norm(), best = at;
  }
  return best;
}

inline double distance_of(const TriangleCorners& y, const Vec3& x) {
  bool over = false;
  return (x - nearest_of(y, x, over)).norm();
}

// Barycentric, of a point in the plane of the triangle.
inline Weights weights_of(const TriangleCorners& y, const Vec3& x) {
  Eigen::Matrix<double, 3, 2> sides;
  sides << y[1] - y[0], y[2] - y[0];
  const Eigen::Vector2d w = sides.colPivHouseholderQr().solve(x - y[0]);
  return {1 - w[0] - w[1], w[0], w[1]};
}

inline TriangleCorners triangle(const std::vector<Vec3>& x, const std::array<Slot, 3>& face) {
  return {x[face[0]], x[face[1]], x[face[2]]};
}

inline TriangleCorners between(const TriangleCorners& a, const TriangleCorners& b, double share) {
  return {(1 - share) * a[0] + share * b[0], (1 - share) * a[1] + share * b[1],
          (1 - share) * a[2] + share * b[2]};
}

struct Side {
  Vec3 normal;
  double gap; // [m]
  Weights weight;
};

// fragment_contact.h, its equations.
inline std::optional<Side> side_of(const TriangleCorners& y, const Vec3& x, bool solid, double thickness) {
  bool over = false;
  const Vec3 p = nearest_of(y, x, over), way = x - p, area = (y[1] - y[0]).cross(y[2] - y[0]);
  const bool known = way.norm() > 1e-10 * (thickness + way.norm() + (y[1] - y[0]).norm());
  if (solid && (over || !known)) {
    const double gap = area.normalized().dot(way);
    if (gap <= -std::max(thickness, 0.2 * std::sqrt(area.norm()))) return {};
    return Side{area.normalized(), gap, weights_of(y, p)};
  }
  if (!known || (solid && way.dot(area) < 0)) return {};
  return Side{way.normalized(), way.norm(), weights_of(y, p)};
}

// Whether a vertex of one is kept out of a face of the other, after the step.
inline bool vertex_touches(const Matter& a, Slot v, const Matter& b, const std::array<Slot, 3>& face) {
  const bool own = &a == &b;
  if (own && (v == face[0] || v == face[1] || v == face[2])) return false;
  const double thickness = 0.5 * (a.thickness + b.thickness);
  const double at_rest = own ? distance_of(triangle(b.rest, face), a.rest[v]) : 1e300;
  const bool same = own && a.fragment[v] == b.fragment[face[0]];
  if (same && (!a.self || at_rest <= 2 * thickness)) return false;
  const TriangleCorners y0 = triangle(b.from, face), y1 = triangle(b.to, face);
  const auto gap_after = [&](const Side& side) {
    return side.normal.dot(a.to[v] - side.weight[0] * y1[0] - side.weight[1] * y1[1] - side.weight[2] * y1[2]);
  };
  auto side = side_of(y0, a.from[v], b.solid, thickness);
  if (!side) return false;
  const double before = side->gap, after = gap_after(*side);
  if (before > thickness && after < thickness) { // where it is as near as that on its way
    const double share = (before - thickness) / (before - after);
    const Vec3 way = side->normal;
    side = side_of(between(y0, y1, share), (1 - share) * a.from[v] + share * a.to[v], b.solid, thickness);
    if (!side || side->gap > 1.5 * thickness || side->normal.dot(way) <= 0) return false;
  }
  double kept = before < 0 ? 0 : thickness;
  if (own && at_rest <= thickness && before >= 0) kept = std::min(kept, before);
  return after < thickness && gap_after(*side) < kept;
}

struct Near {
  Vec3 normal;
  double gap, p, q; // [m]; shares of the way along each
};

// Of two edges, both between their ends; none of parallel ones.
inline std::optional<Near> near_of(const Segment& a, const Segment& b) {
  Eigen::Matrix<double, 3, 2> ways;
  ways << a[1] - a[0], b[0] - b[1];
  const double sine = Vec3(ways.col(0)).normalized().cross(Vec3(ways.col(1)).normalized()).norm();
  if (sine < 1e-3) return {};
  const Eigen::Vector2d s = ways.colPivHouseholderQr().solve(b[0] - a[0]);
  if (s.minCoeff() <= 0 || s.maxCoeff() >= 1) return {};
  const Vec3 way = a[0] + s[0] * (a[1] - a[0]) - b[0] - s[1] * (b[1] - b[0]);
  return way.norm() > 1e-10 ? std::optional(Near{way.normalized(), way.norm(), s[0], s[1]}) : std::nullopt;
}

inline double rest_distance(const Segment& a, const Segment& b) {
  const auto from = [](const Vec3& x, const Segment& y) {
    const Vec3 way = y[1] - y[0];
    return (x - y[0] - std::clamp((x - y[0]).dot(way) / way.dot(way), 0.0, 1.0) * way).norm();
  };
  const double ends = std::min({from(a[0], b), from(a[1], b), from(b[0], a), from(b[1], a)});
  const auto near = near_of(a, b);
  return near ? std::min(ends, near->gap) : ends;
}

using Ends = std::array<Slot, 2>;

// edge_contact.h, of sheets.
inline bool edges_touch(const Matter& a, const Ends& e, const Matter& b, const Ends& f) {
  const double thickness = 0.5 * (a.thickness + b.thickness);
  const auto segment = [](const std::vector<Vec3>& x, const Ends& of) { return Segment{x[of[0]], x[of[1]]}; };
  if (&a == &b) {
    if (!a.self || a.fragment[e[0]] != b.fragment[f[0]]) return false;
    if (e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1]) return false;
    if (rest_distance(segment(a.rest, e), segment(b.rest, f)) <= 2 * thickness) return false;
  }
  const Segment p0 = segment(a.from, e), p1 = segment(a.to, e), q0 = segment(b.from, f), q1 = segment(b.to, f);
  const auto gap_after = [&](const Near& near) {
    return near.normal.dot(p1[0] + near.p * (p1[1] - p1[0]) - q1[0] - near.q * (q1[1] - q1[0]));
  };
  auto near = near_of(p0, q0);
  if (!near) return false;
  const double before = near->gap, after = gap_after(*near);
  if (before > thickness && after < thickness) {
    const double share = (before - thickness) / (before - after);
    const auto on_way = [&](const Segment& x, const Segment& y) {
      return Segment{(1 - share) * x[0] + share * y[0], (1 - share) * x[1] + share * y[1]};
    };
    const Vec3 way = near->normal;
    near = near_of(on_way(p0, p1), on_way(q0, q1));
    if (!near || near->gap > 1.5 * thickness || near->normal.dot(way) <= 0) return false;
  }
  return after < thickness && gap_after(*near) < thickness;
}

// [m], of some of its vertices in the step.
inline Eigen::AlignedBox3d around(const Matter& of, std::span<const Slot> vertices) {
  Eigen::AlignedBox3d box;
  for (const Slot v : vertices) box.extend(of.from[v]).extend(of.to[v]);
  return box;
}

inline bool farther(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b, double than) {
  return a.squaredExteriorDistance(b) > than * than;
}

// The same for either order.
inline Name name_of(std::size_t body, std::array<Slot, 2> edge, std::size_t other,
                    std::array<Slot, 2> other_edge) {
  std::sort(edge.begin(), edge.end());
  std::sort(other_edge.begin(), other_edge.end());
  Name one{body, edge[0], edge[1], other, other_edge[0], other_edge[1]};
  const Name turned{other, other_edge[0], other_edge[1], body, edge[0], edge[1]};
  return std::min(one, turned);
}

// What a step has.
struct Found {
  std::set<std::tuple<std::size_t, Slot, std::size_t, std::size_t>> vertices; // body, vertex, body, triangle
  std::set<Name> edges;
  std::set<std::tuple<std::size_t, Ends, std::size_t, std::size_t>> through; // body, edge, body, triangle
};

inline Found by_brute_force(const std::vector<Matter>& all) {
  Found found;
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < all.size(); ++b) {
      const Matter &one = all[a], &other = all[b];
      const double reach = std::max(2 * std::max(one.thickness, other.thickness), other.solid ? 0.1 : 0.0);
      for (std::size_t t = 0; t < other.faces.size(); ++t) {
        const std::array<Slot, 3>& face = other.faces[t];
        const auto there = around(other, face);
        for (const Slot v : one.vertices)
          if (!farther(around(one, std::array{v}), there, reach) && vertex_touches(one, v, other, face))
            found.vertices.insert({a, v, b, t});
        for (const Ends& edge : one.edges) {
          if (a == b && (!one.self || one.fragment[edge[0]] != one.fragment[face[0]])) continue;
          if (std::ranges::any_of(face, [&](Slot v) { return a == b && (v == edge[0] || v == edge[1]); }))
            continue;
          if (farther(around(one, edge), there, 0)) continue;
          const auto at = [&](const std::vector<Vec3>& x, const std::vector<Vec3>& y) {
            return heaps::goes_through({x[edge[0]], x[edge[1]]}, triangle(y, face));
          };
          if (!at(one.from, other.from) && at(one.to, other.to)) found.through.insert({a, edge, b, t});
        }
      }
      if (b < a || one.solid || other.solid) continue;
      for (const Ends& edge : one.edges)
        for (const Ends& there : other.edges)
          if ((a != b || edge < there) && !farther(around(one, edge), around(other, there), reach) &&
              edges_touch(one, edge, other, there))
            found.edges.insert(name_of(a, edge, b, there));
    }
  return found;
}

} // namespace rend::all_contacts
