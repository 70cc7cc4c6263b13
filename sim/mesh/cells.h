// A solid from points and cells, in linear expected time: α0 to α2 of a cell from a table
// (sim/mesh/cell_shapes.h), α3 where two cells have a face with the same ring of points. Darts are numbered
// cell by cell; vertices then get their slots in the order of their first cells.
//
// A point shared by cells that are not connected through faces at it becomes several vertices.
#pragma once

#include "sim/embedding/embedded_map.h"
#include "sim/mesh/cell_shapes.h"

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

namespace rend {

struct CellMesh {
  std::vector<Vec3> points;              // [m]
  std::vector<CellKind> kinds;           // one per cell
  std::vector<std::uint32_t> corners;    // point indices of all cells, one cell after another, in Gmsh's order
  std::vector<std::uint32_t> first;      // where each cell starts in `corners`; one more entry for the end
  std::vector<std::uint64_t> names;      // of each point in messages; empty: its index
  std::vector<std::uint64_t> cell_names; // of each cell in messages; empty: its index
  std::uint64_t name(std::uint32_t p) const { return p < names.size() ? names[p] : p; }
  std::uint64_t cell_name(std::size_t cell) const { return cell < cell_names.size() ? cell_names[cell] : cell; }
  std::size_t cells() const { return kinds.size(); }
  std::span<const std::uint32_t> corners_of(std::size_t cell) const {
    return {corners.data() + first[cell], first[cell + 1] - first[cell]};
  }
  void add(CellKind kind, std::initializer_list<std::uint32_t> cell);
  void add(CellKind kind, std::span<const std::uint32_t> cell);
};

// [m³], each face taken as its triangle fan around the mean of its corners; negative: the cell is inverted.
double signed_volume(const CellMesh& mesh, std::size_t cell);

struct SewnSolid {
  std::unique_ptr<EmbeddedMap> map; // of dimension 3
  std::vector<std::uint32_t> point; // the index of the point that each vertex slot came from
  std::size_t turned = 0;           // number of inverted cells, which were corrected
};

// Throws MeshFault for a mesh that is no solid: a face of more than two cells, faces that overlap but do not
// match (a quad on two triangles), a cell without volume or with a repeated corner, an index out of range.
SewnSolid sew_cells(const CellMesh& mesh);

inline std::unique_ptr<EmbeddedMap> solid_from(const CellMesh& mesh) {
  return sew_cells(mesh).map;
}

} // namespace rend
