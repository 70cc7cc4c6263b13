// The order of elements in memory: neighbours in space near each other.
//
// Darts, slots and rows follow the order of the elements, and a file may list them in any. Where it does so at
// random, each element finds its corners all over memory. So elements are put along a Hilbert curve through
// their centres (Skilling, Programming the Hilbert curve, 2004), but only where that brings the corners of an
// element at least twice as near to each other in the order in which vertices are met: an order that is good is
// kept.
#pragma once

#include "sim/mesh/cells.h"
#include "sim/mesh/polygons.h"

namespace rend {

constexpr std::size_t points_of_few = 8192; // whose state fits into a cache: any order of elements will do

// order[n]: the element that is to be the n-th; empty: they stand well, or are so few that it makes no
// difference, or are not fit to be sewn.
std::vector<std::uint32_t> order_for_locality(const PolygonMesh& mesh);
std::vector<std::uint32_t> order_for_locality(const CellMesh& mesh);

// The same elements in that order.
PolygonMesh reordered(const PolygonMesh& mesh, const std::vector<std::uint32_t>& order);
CellMesh reordered(const CellMesh& mesh,
                   const std::vector<std::uint32_t>& order); // messages name cells as before

} // namespace rend
