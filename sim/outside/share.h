// Shares: which cells an element of a preset is about, and how much each of them counts.
//
// A share is embedded on what a separation never splits (a corner of an element, an edge or a face of one), so
// that it survives tearing: the fragments of a split vertex have together what the vertex had.
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

// A column on element corners, whose sum is 1: the same for each vertex, and within a vertex for each of its
// corners.
ShareColumn& share_equally(EmbeddedMap& map, const std::string& name, const std::vector<Slot>& vertices);

} // namespace rend
