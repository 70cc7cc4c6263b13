// Shares: the cells to which an element of a preset refers, and the weight of each.
//
// A share is embedded on cells that a separation never splits (a corner, an edge or a face of one element), so
// that it survives tearing: the fragments of a split vertex together have the share that the vertex had.
#pragma once

#include "sim/embedding/embedded_map.h"

#include <string>
#include <vector>

namespace rend {

struct Share {
  using Value = double;
  std::string name;
  Orbit orbit;
  Orbit support = SingleDart;
  Value birth(const EmbeddedMap&, Dart) const { return 0; }
  Value split(const Value& whole) const { return whole; }
  Value merge(const Value& kept, const Value&) const { return kept; }
};
using ShareColumn = Column<Share>;

// A column on element corners with sum 1: equal for all vertices, and within a vertex for all its corners.
ShareColumn& share_equally(EmbeddedMap& map, const std::string& name, const std::vector<Slot>& vertices);

} // namespace rend
