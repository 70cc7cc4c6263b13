#include "sim/boundary/outer_faces.h"

#include "sim/mechanics/winding.h"

#include <algorithm>

namespace rend {

void vertices_of_face(const EmbeddedMap& map, Dart d, bool turned, std::vector<Slot>& out) {
  out.clear();
  Dart at = d;
  do {
    out.push_back(map.vertex(at));
    at = map.map().follow(at, to_next_side);
  } while (at != d);
  if (turned) std::reverse(out.begin(), out.end());
}

} // namespace rend
