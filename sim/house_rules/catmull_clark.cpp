// A step of the subdivision of Catmull and Clark, Recursively generated B-spline surfaces on arbitrary
// topological meshes, 1978; at borders cubic B-splines, as is usual.
//
//   of a face    F, the mean of its corners
//   of an edge   (A + B + F1 + F2)/4 with its ends and the new points of its faces; on the border (A + B)/2
//   of a vertex  (Q + 2R + (n - 3)S)/n with S where it was, n edges, Q the mean of the new points of the faces
//    around
//                it, R that of the middles of its edges; on the border (N1 + 6S + N2)/8 with its neighbours
//                 there
//
// R is (S + N)/2 with N the mean of the neighbours.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings catmull_clark() {
  return {
      .name = "catmull-clark",
      .about =
          "each face of a component of a sheet becomes one quad per corner, and the whole smoother (Catmull "
          "and Clark 1978)",
      .left = "a*(0,1,2) a|3",
      .right = "a(_,1,2) b(_,_,2) c(2,_,_) d(2,1,_) a-0-b b-1-c c-0-d a|3 b|3 c|3 d|3",
      .sets = {{.node = "a",
                .position = "if(size(a, border) > 0, 0.75*a + 0.25*mean(a, border), (mean(a, faces) + "
                            "mean(a, neighbours) + (n - 2)*a)/n)"},
               {.node = "b",
                .position = "if(free(a, 2), mean(a, edge), (2*mean(a, edge) + mean(a, face) + "
                            "mean(alpha(a, 2), face))/4)"},
               {.node = "d", .position = "mean(a, face)"}},
      .lets = {{.name = "n", .value = "size(a, vertex)"}}};
}

} // namespace rend
