// Which side of a face of a sheet is its front, where rules create faces.
//
// The front of a face is where its corners run anticlockwise when it is walked from its smallest dart. What a
// rule creates may have any smallest dart: a face that is divided hands its front on, and each part remembers
// whether that is the walk from its own smallest dart. Only bodies with such a rule have this embedding.
#pragma once

#include "sim/embedding/embedded_map.h"
#include "sim/topology/orientation.h"

namespace rend {

struct FaceSense {
  using Value = std::uint8_t; // 1: the front is that of the reversed walk
  std::string name = "front of a face";
  Orbit orbit = FaceOfVolume;
  Orbit support = FaceOfVolume;
  Value birth(const EmbeddedMap&, Dart) const { return 0; }
  Value split(const Value& whole) const { return whole; }
  Value inherit(const EmbeddedMap& map, Dart d, std::span<const Inherited<Value>> parents) const {
    const Inherited<Value>& parent = parents.front();
    return turns_alike(map.map(), parent.dart, d) ? parent.value : static_cast<Value>(1 - parent.value);
  }
};

// The embedding of this map; null: it has none, and all walks from smallest darts show fronts.
inline const Column<FaceSense>* find_face_sense(const EmbeddedMap& map) {
  return find_column<FaceSense>(map);
}

// Whether the front of a face is that of the walk from α1 of its smallest dart. sense: null as above.
inline bool is_turned(const Column<FaceSense>* sense, Slot face) {
  return sense && (*sense)[face] != 0;
}

} // namespace rend
