// Quantities of a solid's surface, computed triangle by triangle.
#pragma once

#include "sim/body/body.h"
#include "sim/boundary/solid_surface.h"

#include <map>
#include <utility>
#include <vector>

namespace rend::solids {

inline std::vector<BoundaryTriangle> triangles_of(const SolidSurface& surface) {
  std::vector<BoundaryTriangle> all;
  surface.for_each_triangle([&](const BoundaryTriangle& t) { all.push_back(t); });
  return all;
}

inline std::vector<Vec3> normals_of(SolidSurface& surface) {
  std::vector<Vec3> normals;
  surface.normals(normals);
  return normals;
}

inline Vec3 place(const Body& body, Slot v) {
  return body.map->position()[v].vec();
}

inline Vec3 area_vector(const Body& body, const BoundaryTriangle& t) {
  const Vec3 a = place(body, t.vertex[0]);
  return 0.5 * (place(body, t.vertex[1]) - a).cross(place(body, t.vertex[2]) - a);
}

// The volume enclosed by the triangles.
inline double volume_of(const Body& body, const SolidSurface& surface) {
  double sum = 0;
  for (const BoundaryTriangle& t : triangles_of(surface))
    sum += place(body, t.vertex[0]).dot(area_vector(body, t)) / 3;
  return sum;
}

// For each directed side of a triangle, how often it occurs minus how often its opposite does: empty for a
// closed surface.
inline std::map<std::pair<Slot, Slot>, int> open_sides(const SolidSurface& surface) {
  std::map<std::pair<Slot, Slot>, int> count;
  for (const BoundaryTriangle& t : triangles_of(surface))
    for (std::size_t k = 0; k < 3; ++k) {
      const Slot a = t.vertex[k], b = t.vertex[(k + 1) % 3];
      if (a < b)
        ++count[{a, b}];
      else
        --count[{b, a}];
    }
  std::erase_if(count, [](const auto& side) { return side.second == 0; });
  return count;
}

} // namespace rend::solids
