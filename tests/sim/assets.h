// The maps that tests run over: small, built by rules where possible, and each irregular in its own way.
#pragma once

#include "sim/embedding/embedded_map.h"
#include "sim/house_rules/house_rules.h"
#include "sim/rules/apply.h"
#include "sim/topology/count.h"
#include "sim/topology/walk.h"

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace rend::assets {

using Body = std::unique_ptr<EmbeddedMap>;

inline Point at(double x, double y, double z = 0) {
  return {{x, y, z}, {x, y, z}, {0, 0, 0}};
}

// The corners p, q, r, s of a rule that creates a face.
inline RuleArguments corners(std::initializer_list<Point> points) {
  RuleArguments arguments;
  char name = 'p';
  for (const Point& point : points) {
    const Vec3& x = point.position;
    arguments.push_back({std::string(1, name++), vector_value(x.x(), x.y(), x.z())});
  }
  return arguments;
}

// A face with as many sides as there are points (at least three), free on all sides; returns two darts per
// side, d and α0(d), side by side: d is at the point of its side.
inline std::vector<Dart> create_polygon(Edit& edit, std::span<const Point> points) {
  std::vector<Dart> darts;
  for (std::size_t n = 0; n < 2 * points.size(); ++n) darts.push_back(edit.add_dart());
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Dart first = darts[2 * n], last = darts[2 * n + 1];
    const Dart before = darts[(2 * n + 2 * points.size() - 1) % (2 * points.size())];
    edit.link(0, first, last);
    edit.link(1, before, first);
    const std::uint32_t point = edit.add_point(points[n]);
    edit.give(before, point);
    edit.give(first, point);
  }
  return darts;
}

// Removes a face from a sheet, or a volume from a solid, whatever it is sewn to, itself included.
inline void remove_element(Edit& edit, Dart d) {
  const int dimension = edit.map().dimension();
  for (Dart e : darts_of(edit.map(), element_orbit(dimension), d)) unsew(edit, dimension, e);
  remove_orbit(edit, element_orbit(dimension), d);
}

inline std::vector<Dart> all_darts(const GMap& map) {
  std::vector<Dart> darts;
  map.for_each_dart([&](Dart d) { darts.push_back(d); });
  return darts;
}

// The four links of every dart, removed ones included: equal lists mean identical maps.
inline std::vector<std::array<std::uint32_t, 4>> links(const GMap& map) {
  std::vector<std::array<std::uint32_t, 4>> all(map.capacity());
  map.for_each_dart([&](Dart d) {
    for (int i = 0; i < 4; ++i) all[d.value][static_cast<std::size_t>(i)] = map.alpha(i, d).value + 1;
  });
  return all;
}

inline Dart add_quad(EmbeddedMap& body, double x, double y) {
  return apply(rule("create-quad"), body, {}, corners({at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)}))
      .dart("a");
}

// Sews every pair of α2-free edges whose end points coincide.
inline void sew_coincident(EmbeddedMap& body) {
  const GMap& map = body.map();
  const auto place = [&](Dart d) { return body.position_of(d); };
  const std::vector<Dart> darts = all_darts(map);
  for (Dart a : darts)
    for (Dart b : darts)
      if (a < b && map.is_free(2, a) && map.is_free(2, b) && map.alpha(0, a) != b && place(a) == place(b) &&
          place(map.alpha(0, a)) == place(map.alpha(0, b)))
        apply(rule("sew-edges"), body, {a, b});
}

inline Body single_quad() {
  auto body = std::make_unique<EmbeddedMap>(2);
  add_quad(*body, 0, 0);
  return body;
}

inline Body triangle() {
  auto body = std::make_unique<EmbeddedMap>(2);
  apply(rule("create-triangle"), *body, {}, corners({at(0, 0), at(1, 0), at(0, 1)}));
  return body;
}

inline Body grid(int columns, int rows) {
  auto body = std::make_unique<EmbeddedMap>(2);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) add_quad(*body, x, y);
  sew_coincident(*body);
  return body;
}

// Built by rules as in thesis 3.4.2: vertex, edge, face, subdivision. 2^levels cells on a side.
inline Body checkerboard(int levels) {
  auto body = std::make_unique<EmbeddedMap>(2);
  const Dart d = apply(rule("create-vertex"), *body).dart("a");
  apply(rule("extrude-vertex"), *body, d);
  apply(rule("extrude-edge"), *body, d);
  for (int n = 0; n < levels; ++n) apply(rule("quarter-faces"), *body, d);
  return body;
}

inline Body triangulated_grid(int columns, int rows) {
  Body body = grid(columns, rows);
  std::vector<Dart> faces;
  body->map().for_each_dart([&](Dart d) {
    if (smallest_dart(body->map(), FaceOfVolume, d) == d) faces.push_back(d);
  });
  for (Dart d : faces) apply(rule("star-face"), *body, d);
  return body;
}

// n triangles around a vertex, open.
inline Body fan(int n) {
  auto body = std::make_unique<EmbeddedMap>(2);
  const auto rim = [](int k) { return at(std::cos(0.3 * k), std::sin(0.3 * k)); };
  for (int k = 0; k < n; ++k)
    apply(rule("create-triangle"), *body, {}, corners({at(0, 0), rim(k), rim(k + 1)}));
  sew_coincident(*body);
  return body;
}

// A strip of n quads whose ends are sewn to each other, straight or with a twist; bent into a ring, so that no
// quad is degenerate.
inline Body loop_of_quads(int n, bool twisted) {
  Body body = grid(n, 1);
  const GMap& map = body->map();
  const auto find = [&](double x, double y) { // an α2-free dart there, of a vertical edge
    for (Dart d : all_darts(map))
      if (map.is_free(2, d) && body->position_of(d) == Vec3(x, y, 0) &&
          body->position_of(map.alpha(0, d)).x() == x)
        return d;
    return Dart{};
  };
  const Dart first = find(0, 0), last = find(n, twisted ? 1 : 0);
  apply(rule("sew-edges"), *body, {first, last});
  for (VertexColumn* column : {&body->position(), &body->rest()})
    for (Record& value : column->values()) {
      const Vec3 x = value.vec();
      const double around = 2 * M_PI * x.x() / n, turn = twisted ? around / 2 : 0, across = x.y() - 0.5;
      const double radius = 0.5 * n + across * std::cos(turn);
      value = Record(radius * std::cos(around), radius * std::sin(around), across * std::sin(turn));
    }
  return body;
}

// A grid with a slit that ends inside.
inline Body torn_sheet() {
  Body body = grid(4, 2);
  for (Dart d : all_darts(body->map())) {
    const Vec3 p = body->position_of(d), q = body->position_of(body->map().alpha(0, d));
    if (p.y() == 1 && q.y() == 1 && p.x() + q.x() < 4) apply(rule("unsew-edge"), *body, d);
  }
  return body;
}

// Faces of three, four and five sides.
inline Body mixed_sheet() {
  auto body = std::make_unique<EmbeddedMap>(2);
  add_quad(*body, 0, 0);
  apply(rule("create-triangle"), *body, {}, corners({at(1, 0), at(2, 0.5), at(1, 1)}));
  body->edit([](Edit& edit) {
    const std::array<Point, 5> points{at(0, 1), at(1, 1), at(1.2, 1.5), at(0.5, 2), at(-0.2, 1.5)};
    create_polygon(edit, points);
  });
  sew_coincident(*body);
  return body;
}

// Triangles, quads and pentagons sewn at random: any surface, orientable or not, with edges sewn to themselves.
inline Body random_sewing(unsigned seed, int faces, int attempts) {
  std::mt19937 random(seed);
  const auto coordinate = [&] { return static_cast<double>(random() % 100); };
  auto body = std::make_unique<EmbeddedMap>(2);
  body->edit([&](Edit& edit) {
    for (int f = 0; f < faces; ++f) {
      std::vector<Point> points(3 + random() % 3);
      for (Point& p : points) p = at(coordinate(), coordinate(), coordinate());
      create_polygon(edit, points);
    }
  });
  const std::vector<Dart> darts = all_darts(body->map());
  body->edit([&](Edit& edit) {
    for (int n = 0; n < attempts; ++n)
      sew(edit, 2, darts[random() % darts.size()], darts[random() % darts.size()]);
  });
  return body;
}

// The hexahedron with a corner at x: six quads sewn along their edges. Returns for each face, -x +x -y +y -z
// +z, the dart at the face's lowest corner whose edge runs along the first axis in the face's plane.
inline std::array<Dart, 6> add_cube(MapEdit& edit, std::vector<Vec3>& place, const Vec3& x) {
  std::vector<Dart> darts;
  std::array<Dart, 6> faces;
  for (int f = 0; f < 6; ++f) {
    const int axis = f / 2, u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    std::array<Dart, 8> ring;
    for (Dart& d : ring) darts.push_back(d = edit.add_dart());
    for (std::size_t n = 0; n < 4; ++n) {
      edit.link(0, ring[2 * n], ring[2 * n + 1]);
      edit.link(1, ring[2 * n + 1], ring[(2 * n + 2) % 8]);
      Vec3 corner = x;
      corner[axis] += f % 2;
      corner[u] += n == 1 || n == 2;
      corner[v] += n >= 2;
      place.resize(edit.map().capacity());
      place[ring[2 * n].value] = place[ring[(2 * n + 7) % 8].value] = corner;
    }
    faces[static_cast<std::size_t>(f)] = ring[0];
  }
  const auto far = [&](Dart d) { return place[edit.map().alpha(0, d).value]; };
  for (Dart a : darts)
    for (Dart b : darts)
      if (a < b && edit.map().is_free(2, a) && edit.map().is_free(2, b) && place[a.value] == place[b.value] &&
          far(a) == far(b))
        sew(edit, 2, a, b);
  return faces;
}

inline Body row_of_cubes(int n) {
  GMap map(3);
  MapEdit edit(map);
  std::vector<Vec3> place;
  Dart last;
  for (int k = 0; k < n; ++k) {
    const auto faces = add_cube(edit, place, Vec3(k, 0, 0));
    if (last) sew(edit, 3, last, faces[0]);
    last = faces[1];
  }
  return std::make_unique<EmbeddedMap>(std::move(map), [&](Dart d) {
    const Vec3& p = place[d.value];
    return at(p.x(), p.y(), p.z());
  });
}

struct Asset {
  std::string name;
  std::function<Body()> make;
};

inline std::vector<Asset> all() {
  return {{"nothing", [] { return std::make_unique<EmbeddedMap>(2); }},
          {"vertex",
           [] {
             auto body = std::make_unique<EmbeddedMap>(2);
             apply(rule("create-vertex"), *body);
             return body;
           }},
          {"edge",
           [] {
             auto body = std::make_unique<EmbeddedMap>(2);
             const Dart d = apply(rule("create-vertex"), *body).dart("a");
             apply(rule("extrude-vertex"), *body, d);
             return body;
           }},
          {"quad", single_quad},
          {"triangle", triangle},
          {"grid 3x2", [] { return grid(3, 2); }},
          {"triangulated grid", [] { return triangulated_grid(2, 2); }},
          {"checkerboard", [] { return checkerboard(2); }},
          {"fan", [] { return fan(5); }},
          {"loop", [] { return loop_of_quads(4, false); }},
          {"Moebius strip", [] { return loop_of_quads(5, true); }},
          {"torn sheet", torn_sheet},
          {"mixed sheet", mixed_sheet},
          {"random sewing", [] { return random_sewing(1, 12, 60); }},
          {"dense random sewing", [] { return random_sewing(2, 12, 4000); }},
          {"cube", [] { return row_of_cubes(1); }},
          {"two cubes", [] { return row_of_cubes(2); }}};
}

// Another value for each argument of a rule that is a point.
inline RuleArguments some_arguments(const Rule& rule) {
  const std::array<Vec3, 4> points{Vec3(0, 0, 0), Vec3(1, 0, 0.1), Vec3(1, 1, 0), Vec3(0, 1, 0.2)};
  RuleArguments arguments;
  for (const Rule::Where& where : rule.wheres)
    if (where.type == ValueType::Vector) {
      const Vec3& p = points[arguments.size() % points.size()];
      arguments.push_back({where.name, vector_value(p.x(), p.y(), p.z() + 1)});
    }
  return arguments;
}

} // namespace rend::assets
