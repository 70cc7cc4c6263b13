// Orientation of a map: a 2-colouring of its darts such that every link leads from one colour to the other
// (Lienhardt 1994).
//
// Walks around faces that start at darts of one colour have the same orientation, those from the other colour
// the opposite one. A Möbius band has no such colouring.
#pragma once

#include "sim/topology/gmap.h"

#include <cstdint>
#include <vector>

namespace rend {

struct Sides {
  std::vector<std::uint8_t> of_dart; // 1 or 2, one per dart; the smallest of each component has 1; 0: removed
  bool orientable = true;            // false: some link joins two darts of one colour
};
Sides sides_of(const GMap& map);

// Whether a path of an even number of links leads from a to b, a shortest one: found as soon as they are near
// to each other. True if there is none, or a is removed.
bool turns_alike(const GMap& map, Dart a, Dart b);

inline bool is_orientable(const GMap& map) {
  return sides_of(map).orientable;
}

} // namespace rend
