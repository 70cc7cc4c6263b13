#include "sim/fracture/border.h"

#include "sim/base/check.h"
#include "sim/mechanics/mass.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

// The mean normal of the face of d, walked from d along α0 first (Newell's sum; unit, or 0 without area).
Vec3 face_normal(const EmbeddedMap& map, const Record* x, Dart d) {
  Vec3 sum = Vec3::Zero();
  const Vec3 origin = x[map.vertex(d)];
  Dart at = d;
  do {
    const Dart end = map.map().alpha(0, at);
    sum += (x[map.vertex(at)].vec() - origin).cross(x[map.vertex(end)].vec() - origin);
    at = map.map().alpha(1, end);
  } while (at != d);
  const double length = sum.norm();
  if (length > 0) sum /= length;
  return sum;
}

constexpr int most_sides = static_cast<int>(most_columns / 3);

// Of a map that grows, also those that volumes may come to have: they are the standard ones.
int most_sides_of(const EmbeddedMap& map) {
  int most = map.grows() ? 4 : 3;
  for_each_face(map, [&](Dart d) { most = std::max(most, sides_of_face(map.map(), d)); });
  return most;
}

// The word to the n-th vertex around the face, on this or the other side of it.
Word around(bool other, int n) {
  Word word(other ? 1 : 0, '3');
  if (n > 0) word += '0';
  for (int k = 1; k < n; ++k) word.append("10");
  return word;
}

Binder edges_of_sheet(EmbeddedMap& map, Borders::Carry carry) {
  const Pattern pattern{
      .owner = EdgeOfVolume,
      .support = EdgeOfVolume,
      .units = {{"", "0"}},
      .fold = {},
      .present = [](const GMap& m, Dart d, std::size_t) { return !m.is_free(2, d) && !m.is_free(0, d); }};
  map.use(EdgeOfVolume);
  if (carry == Borders::Carry::Vertices) return Binder(map, pattern, {{{""}, Vertex}, {{"0"}, Vertex}}, 2);
  const Orbit corner = corner_orbit(2);
  map.use(corner);
  return Binder(
      map, pattern,
      {{{""}, corner}, {{"2"}, corner}, {{"0"}, corner}, {{"20"}, corner}, {{""}, Vertex}, {{"0"}, Vertex}}, 0);
}

Binder faces_of_solid(EmbeddedMap& map, Borders::Carry carry) {
  const int most = most_sides_of(map);
  CHECK(most <= most_sides);
  Pattern pattern{.owner = Face,
                  .support = Face,
                  .units = {},
                  .fold = {},
                  .present = [](const GMap& m, Dart d, std::size_t unit) {
                    return !m.is_free(3, d) && sides_of_face(m, d) == static_cast<int>(unit) + 3;
                  }};
  map.use(Face);
  std::vector<IndexColumn> columns;
  // columns beyond the number of sides repeat the first vertex
  const auto add = [&](bool other, int vertex, Orbit orbit) {
    map.use(orbit);
    IndexColumn& column = columns.emplace_back(IndexColumn{{}, orbit});
    for (int sides = 3; sides <= most; ++sides) column.word.push_back(around(other, vertex % sides));
  };
  for (int k = 0; k < most && carry == Borders::Carry::Corners; ++k)
    for (bool other : {false, true}) add(other, k, corner_orbit(3));
  for (int k = 0; k < most; ++k) add(false, k, Vertex);
  pattern.units.resize(static_cast<std::size_t>(most - 2));
  return Binder(map, pattern, std::move(columns), 0);
}

} // namespace

std::string lacking_for_borders(const EmbeddedMap& map) {
  const int most = map.dimension() == 3 ? most_sides_of(map) : 0;
  if (most <= most_sides) return {};
  return fmt::format("takes faces of up to {} sides, and one here has {}", most_sides, most);
}

Borders::Borders(EmbeddedMap& map, Carry carry)
    : map_(&map), binder_(map.dimension() == 2 ? edges_of_sheet(map, carry) : faces_of_solid(map, carry)) {
  if (carry == Carry::Corners) first_vertex_ = of_sheet() ? 4 : 2 * (binder_.pattern().units.size() + 2);
  binder_.bind();
}

Vec3 across_border(const EmbeddedMap& map, const Record* x, Dart d) {
  if (map.dimension() == 3) return face_normal(map, x, d);
  const Vec3 along = x[map.vertex(map.map().alpha(0, d))].vec() - x[map.vertex(d)].vec();
  // Consistently oriented faces walk their common edge in opposite directions: the other one starts from B.
  const Dart other = map.map().alpha(0, map.map().alpha(2, d));
  const Vec3 n1 = face_normal(map, x, d), n2 = face_normal(map, x, other);
  Vec3 normal = n1 + n2;
  if (normal.norm() < 1e-12) normal = n1;
  Vec3 across = along.cross(normal);
  const double length = across.norm();
  if (length > 0) across /= length;
  return across;
}

} // namespace rend
