// An edge shrinks to its middle, and with it the triangles on its sides: what lies beyond their other two sides
// meets (Hoppe et al. 1993). Where its ends have a common neighbour that is no corner of these triangles, two
// faces come to lie on each other; the rule does not see that.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings collapse_edge() {
  using At = RuleWhenSettings::At;
  return {.name = "collapse-edge",
          .about =
              "an edge of a sheet of triangles shrinks to its middle, and the triangles on its sides are gone",
          .left = "a*(0,2) b(_,_) c(1,_) d(_,_) e(_,_) a-1-b b-0-c b-2-d c-2-e d-0-e a|3 b|3 c|3 d|3 e|3",
          .right = "d(2,_) e(2,_) d-0-e d|3 e|3",
          .sets = {{.node = "d", .position = "mean(a, edge)"}},
          .whens = {{.test = "size(c, vertex) > 3",
                     .at = At::All,
                     .otherwise = "the faces at a far corner would lie on each other"},
                    {.test = "free(a, 2) or size(a, border) == 0 or size(alpha(a, 0), border) == 0",
                     .at = At::All,
                     .otherwise = "it joins two borders"}}};
}

} // namespace rend
