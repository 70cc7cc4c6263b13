#include "sim/boundary/hull.h"

#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {

Dart smallest_of_face(const GMap& map, Dart d) {
  Dart smallest = d;
  walk_two(map, 0, 1, d, [&](Dart e) { smallest = std::min(smallest, e); });
  return smallest;
}

} // namespace rend
