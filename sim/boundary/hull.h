// Walks on the boundary of a solid (its hull): the α3-free faces, as a closed surface.
//
// Around an edge of the solid, <2,3> leads from volume to volume; if the edge is on the hull this is a path,
// and its two ends are the two hull faces there:
//
//   d ─2─ · ─3─ · ─2─ · ─3─ ... ─2─ e        d, e α3-free
//
// So an edge of the map never has more than two hull faces, and e is found without marks; volumes that touch
// along a line without sharing a face are not connected by such a path. With α0, α1 and this step in place of
// α2 the hull is a 2-dimensional map: around a vertex, α1 and the step alternate over a fan of corners. A
// vertex where the solid is pinched has several fans.
#pragma once

#include "sim/mechanics/winding.h"

namespace rend {

// The dart at the other end of the path, at the same vertex; d itself if the volume is open there (α2-free).
inline Dart across_hull_edge(const GMap& map, Dart d) {
  Dart e = map.alpha(2, d);
  while (!map.is_free(3, e)) e = map.alpha(2, map.alpha(3, e));
  return e;
}

// The smallest dart of <0,1>(d).
Dart smallest_of_face(const GMap& map, Dart d);

} // namespace rend
