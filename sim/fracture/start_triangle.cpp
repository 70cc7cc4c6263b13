#include "sim/fracture/start_triangle.h"

#include "sim/mechanics/interaction.h"

#include <algorithm>

namespace rend {

TriangleSizes::TriangleSizes(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double u = (b - a).norm(), v = (c - b).norm(), w = (a - c).norm();
  twice_area = (b - a).cross(c - a).norm();
  sine = twice_area * std::min({u, v, w}) / (u * v * w);
}

TriangleSizes StartTriangle::birth(const EmbeddedMap& map, Dart d) const {
  const GMap& g = map.map();
  return {map.rest_of(d), map.rest_of(g.alpha(0, d)), map.rest_of(g.alpha(0, g.alpha(1, d)))};
}

const Column<StartTriangle>* find_start_triangles(const EmbeddedMap& map) {
  for (const auto& column : map.columns())
    if (const auto* found = dynamic_cast<const Column<StartTriangle>*>(column.get())) return found;
  return nullptr;
}

Column<StartTriangle>* find_start_triangles(EmbeddedMap& map) {
  return const_cast<Column<StartTriangle>*>(find_start_triangles(std::as_const(map)));
}

void add_start_triangles(EmbeddedMap& map) {
  if (map.dimension() == 2 && !find_start_triangles(map)) map.add(StartTriangle{});
}

void hand_on_start_triangles(const EmbeddedMap& from, EmbeddedMap& to, std::span<const Dart> order,
                             double scale) {
  const Column<StartTriangle>* old = find_start_triangles(from);
  if (!old) return;
  add_start_triangles(to);
  Column<StartTriangle>& start = *find_start_triangles(to);
  for_each_face(to, [&](Dart d) {
    TriangleSizes& sizes = start[to.slot(FaceOfVolume, d)];
    sizes = (*old)[from.slot(FaceOfVolume, order[d.value])];
    sizes.scale(scale);
  });
}

} // namespace rend
