// Shares: the cells to which an element of a preset refers, and the weight of each.
//
// A share is embedded on cells that a separation never splits (a corner, an edge or a face of one element), so
// that it survives tearing: the fragments of a split vertex together have the share that the vertex had.
//
// Where an edit divides cells and says so (Edit::inherit), the fragments of a corner together have its share,
// and a new corner has none: a force or a probe stays at the points that were selected. An edge or a face is in
// the patch if the ones are that it was cut from; a face that goes around the other way than its parent changes
// its sign.
#pragma once

#include "sim/embedding/embedded_map.h"

#include <string>
#include <vector>

namespace rend {

struct Share {
  using Value = double;
  Share(std::string name_, Orbit orbit_)
      : name(std::move(name_)), orbit(orbit_),
        inheritance(orbit.has(0) ? Inheritance::Mean : Inheritance::Share) {}
  std::string name;
  Orbit orbit;
  Orbit support = SingleDart;
  Inheritance inheritance;
  Value birth(const EmbeddedMap&, Dart) const { return 0; }
  Value split(const Value& whole) const { return whole; }
  Value merge(const Value& kept, const Value&) const { return kept; }
  Value inherit(const EmbeddedMap& map, Dart d, std::span<const Inherited<Value>> parents) const;
};
using ShareColumn = Column<Share>;

// A column on element corners with sum 1: equal for all vertices, and within a vertex for all its corners.
ShareColumn& share_equally(EmbeddedMap& map, const std::string& name, const std::vector<Slot>& vertices);

} // namespace rend
