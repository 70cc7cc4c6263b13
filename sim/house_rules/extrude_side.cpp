// A further volume, swept by a face of the hull.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings extrude_side() {
  return {.name = "extrude-side",
          .about = "a further volume, swept by a face of the hull",
          .left = "a*(0,1) a|3",
          .right = "a(0,1) g(0,1) b(0,_) c(_,2) d(_,2) e(0,_) f(0,1) a-3-g g-2-b b-1-c c-0-d d-1-e e-2-f b|3 "
                   "c|3 d|3 e|3 f|3",
          .sets = {{.node = "f", .position = "a + v"}},
          .wheres = {{.name = "v", .value = "point(1, 0, 0)"}}};
}

} // namespace rend
