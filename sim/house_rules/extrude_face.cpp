// A volume swept by a face that has none.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings extrude_face() {
  return {.name = "extrude-face",
          .about = "a volume swept by a face that has none",
          .left = "a*(0,1) a|2,3",
          .right = "a(0,1) b(0,_) c(_,2) d(_,2) e(0,_) f(0,1) a-2-b b-1-c c-0-d d-1-e e-2-f a|3 b|3 c|3 d|3 "
                   "e|3 f|3",
          .sets = {{.node = "f", .position = "a + v"}},
          .wheres = {{.name = "v", .value = "point(0, 0, 1)"}}};
}

} // namespace rend
