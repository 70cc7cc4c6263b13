// The numbering of darts that sew_cells gives, for a solid that was read as a map: cells by their smallest
// dart; within a tetrahedron, hexahedron, prism or pyramid as listed in sim/mesh/cell_shapes.h, its first dart
// so chosen that the corners are right-handed. Code that finds corners by words from the first dart of a volume
// relies on it.
#pragma once

#include "sim/mesh/reader.h"

namespace rend {

// The darts of the cell in the order of its shape's table, with d as number 0; empty: the cell of d does not
// have that shape.
std::vector<Dart> darts_in_shape_order(const GMap& map, const CellShape& shape, Dart d);

// order[n]: the dart that gets number n. A cell of another shape keeps the order of its darts.
std::vector<Dart> cell_order(const MapMesh& mesh);

// The same map with its darts renumbered.
MapMesh renumbered(const MapMesh& mesh, const std::vector<Dart>& order);

} // namespace rend
