// The order of elements in memory: neighbours in space close in memory.
//
// Darts, slots and rows follow the order of the elements, and a file may list them in any order. If it is
// random, the corners of each element are scattered over memory. So elements are sorted along a Hilbert curve
// through their centres (Skilling, Programming the Hilbert curve, 2004), but only if that at least halves the
// distance between the corners of an element, with vertices numbered as elements first use them: a good order
// is kept.
#pragma once

#include "sim/mesh/cells.h"
#include "sim/mesh/polygons.h"

namespace rend {

constexpr std::size_t small_mesh_points = 8192; // their state fits into a cache, whatever the order

// order[n]: the element that becomes number n; empty: the order is good, or the elements are so few that it
// makes no difference, or they cannot be sewn.
std::vector<std::uint32_t> order_for_locality(const PolygonMesh& mesh);
std::vector<std::uint32_t> order_for_locality(const CellMesh& mesh);

// The same elements in that order, and their texture coordinates.
PolygonMesh reordered(const PolygonMesh& mesh, const std::vector<std::uint32_t>& order);
CellMesh reordered(const CellMesh& mesh,
                   const std::vector<std::uint32_t>& order); // messages keep the names of cells

} // namespace rend
