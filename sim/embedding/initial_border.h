// Which sides of elements were exposed by fracture: an embedding that stores the initial boundary.
#pragma once

#include "sim/embedding/embedded_map.h"

#include <cstdint>
#include <string>

namespace rend {

// Whether a side of an element (an edge of a face in a sheet, a face of a volume in a solid) was on the
// boundary when its element was created: a side that is on the boundary now and was not then has been torn. The
// parts of a side that is divided are as it was, so that a torn side stays torn.
struct InitialBorder {
  using Value = std::uint8_t;
  explicit InitialBorder(int dimension = 2) : orbit(dimension == 2 ? EdgeOfFace : FaceOfVolume) {}
  std::string name = "born border";
  Orbit orbit;
  Orbit support = SingleDart;
  // In a map that may grow, a new side comes to be inside an element, and was never on the boundary: a cut
  // opens it where it makes it. At the start no map may grow yet.
  Value birth(const EmbeddedMap& map, Dart d) const {
    return !map.grows() && map.map().is_free(map.dimension(), d) ? 1 : 0;
  }
  Value split(const Value& whole) const { return whole; }
  Value merge(const Value& kept, const Value&) const { return kept; }
  // A side that was cut from others: as all of them were.
  Value inherit(const EmbeddedMap&, Dart, std::span<const Inherited<Value>> parents) const {
    Value all = 1;
    for (const Inherited<Value>& parent : parents) all &= parent.value;
    return all;
  }
};
using BorderColumn = Column<InitialBorder>;

// The embedding of this map; null: it has none.
inline const BorderColumn* find_initial_border(const EmbeddedMap& map) {
  return find_column<InitialBorder>(map);
}

} // namespace rend
