// A sheet from points and polygons, in linear time: two darts a side, α0 and α1 around each polygon, α2 where
// two polygons share an edge. Neighbours need not agree in orientation (a Möbius band is legal). Darts are
// numbered polygon after polygon, side after side; vertices then get their slots in the order in which polygons
// meet them.
#pragma once

#include "sim/embedding/embedded_map.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rend {

struct PolygonMesh {
  std::vector<Vec3> points;           // [m]
  std::vector<std::uint32_t> corners; // point indices of all polygons, one polygon after another
  std::vector<std::uint32_t> first;   // where each polygon starts in `corners`; one more entry closes the last
  std::vector<std::uint64_t> names;   // what messages call each point; empty: its index
  std::uint64_t name(std::uint32_t p) const { return p < names.size() ? names[p] : p; }
  std::size_t polygons() const { return first.empty() ? 0 : first.size() - 1; }
  void add(std::initializer_list<std::uint32_t> polygon);
};

struct SewnSheet {
  std::unique_ptr<EmbeddedMap> map; // of dimension 2
  std::vector<std::uint32_t> point; // the index of the point that each vertex slot came from
};

// Throws MeshFault, which is a std::invalid_argument and names the polygon, for what a sheet cannot hold: an
// edge of more than two polygons, a polygon with fewer than three corners or with a corner twice, an index out
// of range. A point where fans meet that share no edge becomes a vertex of each.
SewnSheet sew_polygons(const PolygonMesh& mesh);

inline std::unique_ptr<EmbeddedMap> sheet_from(const PolygonMesh& mesh) {
  return sew_polygons(mesh).map;
}

} // namespace rend
