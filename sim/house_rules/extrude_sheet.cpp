// A sheet becomes a solid: each face is the bottom a of a volume, with a side quad b, c, d, e on each of its
// sides and the top f. Where α2 led from one face to the next, α3 leads from the side quad of one volume to
// that of the next.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings extrude_sheet() {
  return {.name = "extrude-sheet",
          .about = "a sheet becomes a solid: a volume on each face, swept by v",
          .left = "a*(0,1,2) a|3",
          .right =
              "a(0,1,_) b(0,_,3) c(_,2,3) d(_,2,3) e(0,_,3) f(0,1,_) a-2-b b-1-c c-0-d d-1-e e-2-f a|3 f|3",
          .sets = {{.node = "f", .position = "a + v"}},
          .wheres = {{.name = "v", .value = "point(0, 0, 0.1)"}}};
}

} // namespace rend
