// The other diagonal of the quad that two triangles make (Lawson 1977). Its ends are the far corners: the darts
// of the old edge are removed, and those of the new one made. At an end of the old edge the sides b of both
// triangles meet then: where α2 led from a, α1 leads from b.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings flip_edge() {
  using At = RuleWhenSettings::At;
  return {.name = "flip-edge",
          .about =
              "an edge between two triangles of a sheet becomes the other diagonal of the quad that they make",
          .left = "a*(0,2) b(_,_) c(1,_) a-1-b b-0-c a|3 b|3 c|3",
          .right = "b(_,1) c(_,_) d(2,0) b-0-c c-1-d b|3 c|3 d|3",
          .whens = {{.test = "not free(a, 2)", .at = At::All, .otherwise = "the edge lies on the border"},
                    {.test = "dot(cross(c - a, far - a), cross(c - a, alpha(a, 0) - a)) > 0",
                     .at = At::All,
                     .otherwise = "the two triangles make no convex quad"}},
          .lets = {{.name = "far", .value = "alpha(alpha(alpha(a, 2), 1), 0)"}}};
}

} // namespace rend
