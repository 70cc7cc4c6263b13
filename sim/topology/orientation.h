// The two sides of a map: darts told into two classes that every link leads between (Lienhardt 1994).
//
// A walk around a face that starts at a dart of one class runs the one way, from one of the other class the
// other way; faces that are walked from darts of one class run alike. A Möbius band has no such classes.
#pragma once

#include "sim/topology/gmap.h"

#include <cstdint>
#include <vector>

namespace rend {

struct Sides {
  std::vector<std::uint8_t> of_dart; // 1 or 2, one per dart; the smallest of each component has 1; 0: removed
  bool orientable = true;            // false: some link leads within a class
};
Sides sides_of(const GMap& map);

inline bool is_orientable(const GMap& map) {
  return sides_of(map).orientable;
}

} // namespace rend
