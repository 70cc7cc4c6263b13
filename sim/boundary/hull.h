// Walks on the hull of a solid: the α3-free faces, as a surface of their own.
//
// Around an edge of the solid, <2,3> leads from volume to volume; where the edge lies on the hull this is a
// path, and its two ends are the two faces of the hull there:
//
//   d ─2─ · ─3─ · ─2─ · ─3─ ... ─2─ e        d, e α3-free
//
// So an edge of the map never has more than two faces of the hull, and e is found without marks; volumes that
// touch along a line alone are joined by no such path and see nothing of each other. With α0, α1 and this step
// in the place of α2 the hull is a map of dimension 2: around a vertex, α1 and the step in turn are a fan of
// corners. A vertex where the solid is pinched has several.
#pragma once

#include "sim/mechanics/winding.h"

namespace rend {

// The dart at the other end of the path, at the same vertex: d itself where the volume is open (α2-free).
inline Dart across_hull_edge(const GMap& map, Dart d) {
  Dart e = map.alpha(2, d);
  while (!map.is_free(3, e)) e = map.alpha(2, map.alpha(3, e));
  return e;
}

// The smallest dart of <0,1>(d).
Dart smallest_of_face(const GMap& map, Dart d);

} // namespace rend
