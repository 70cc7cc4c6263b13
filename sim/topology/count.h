// Counts of cells, and the Euler characteristic.
#pragma once

#include "sim/topology/gmap.h"

namespace rend {

std::size_t count_cells(const GMap& map, Orbit orbit); // orbits of that kind

struct CellCounts {
  std::size_t vertices = 0, edges = 0, faces = 0, volumes = 0, fragments = 0;
  // V − E + F of a sheet (a disc 1, a band or Möbius band 0, a sphere 2); V − E + F − volumes of a solid (a
  // ball 1).
  long euler = 0;
};
CellCounts count_cells(const GMap& map);

// The number of the connected component of each dart, components numbered by their smallest dart.
// One entry per dart (capacity); removed darts have none_value.
std::vector<std::uint32_t> label_fragments(const GMap& map);

} // namespace rend
