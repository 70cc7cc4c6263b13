// The order of darts that sew_cells gives, for a solid that came as a map: cells by their smallest dart; within
// a tetrahedron, hexahedron, prism or pyramid as sim/mesh/cell_shapes.h lists them, its first dart so chosen
// that the corners stand right-handed. Whoever reads corners by words from a volume's first dart may rely on
// it.
#pragma once

#include "sim/mesh/reader.h"

namespace rend {

// The darts that a cell's table has, in its order, if that of number 0 is d; empty: the cell at d is not of
// that shape.
std::vector<Dart> laid_out(const GMap& map, const CellShape& shape, Dart d);

// order[n]: the dart that is to have the number n. A cell of another shape keeps the order of its darts.
std::vector<Dart> cell_order(const MapMesh& mesh);

// The same map with its darts renumbered.
MapMesh renumbered(const MapMesh& mesh, const std::vector<Dart>& order);

} // namespace rend
