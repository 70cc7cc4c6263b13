// A sheet from points and polygons, in linear time: two darts per side, α0 and α1 around each polygon, α2 where
// two polygons share an edge. Neighbours need not agree in orientation (a Möbius band is allowed). Darts are
// numbered polygon by polygon, side by side; vertices then get their slots in the order of their first
// polygons.
#pragma once

#include "sim/embedding/texture_coordinates.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rend {

struct PolygonMesh {
  std::vector<Vec3> points;           // [m]
  std::vector<std::uint32_t> corners; // point indices of all polygons, one polygon after another
  std::vector<std::uint32_t> first;   // where each polygon starts in `corners`; one more entry for the end
  std::vector<std::uint64_t> names;   // of each point in messages; empty: its index
  std::vector<TexturePlace> texture;  // one per entry of `corners`; empty: there are none
  std::uint64_t name(std::uint32_t p) const { return p < names.size() ? names[p] : p; }
  std::size_t polygons() const { return first.empty() ? 0 : first.size() - 1; }
  void add(std::initializer_list<std::uint32_t> polygon);
};

// The area [m²] of the triangles from the middle of its corners, and the square of the largest distance of a
// corner from there [m²].
struct PolygonExtent {
  double area = 0, square = 0;
  bool has_area() const { return area > 1e-12 * square; } // below it is round-off
};
PolygonExtent extent_of(const PolygonMesh& mesh, std::size_t polygon);

struct SewnSheet {
  std::unique_ptr<EmbeddedMap> map; // of dimension 2
  std::vector<std::uint32_t> point; // the index of the point that each vertex slot came from
};

// Throws MeshFault, which is a std::invalid_argument and names the polygon, for a mesh that is no sheet: an
// edge of more than two polygons, a polygon with fewer than three corners or a repeated corner, an index out of
// range. A point shared by fans of polygons that have no common edge there becomes a vertex of each. Texture
// coordinates, where there are some, become an embedding.
SewnSheet sew_polygons(const PolygonMesh& mesh);

inline std::unique_ptr<EmbeddedMap> sheet_from(const PolygonMesh& mesh) {
  return sew_polygons(mesh).map;
}

} // namespace rend
