#include "sim/fracture/border.h"

#include "sim/mechanics/mass.h"

namespace rend {
namespace {

// The normal of the face of d, walked from d along α0 first (Newell's sum; unit, or 0 without area).
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

} // namespace

Binder bind_borders(EmbeddedMap& map, bool corners) {
  const Pattern pattern{
      .owner = EdgeOfVolume,
      .support = EdgeOfVolume,
      .units = {{"", "0"}},
      .fold = {},
      .present = [](const GMap& m, Dart d, std::size_t) { return !m.is_free(2, d) && !m.is_free(0, d); }};
  std::vector<Field> fields{{{""}, Vertex}, {{"0"}, Vertex}};
  if (corners) {
    const Orbit corner = corner_orbit(map.dimension());
    map.use(corner);
    for (const char* word : {"", "0", "2", "20"}) fields.push_back({{word}, corner});
  }
  map.use(EdgeOfVolume);
  Binder binder(map, pattern, std::move(fields), 2);
  binder.bind();
  return binder;
}

Vec3 across_border(const EmbeddedMap& map, const Record* x, Dart d) {
  const Vec3 along = x[map.vertex(map.map().alpha(0, d))].vec() - x[map.vertex(d)].vec();
  // Faces that agree walk their common edge in opposite directions: the other one from B.
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
