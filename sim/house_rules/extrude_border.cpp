// A quad beside a sheet, swept by an edge of its border.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings extrude_border() {
  return {.name = "extrude-border",
          .about = "a quad beside a sheet, swept by an edge of its border",
          .left = "a*(0) a|2,3",
          .right = "a(0) e(0) b(_) c(_) d(0) a-2-e e-1-b b-0-c c-1-d a|3 e|3 b|2,3 c|2,3 d|2,3",
          .sets = {{.node = "c", .position = "a + v"}},
          .wheres = {{.name = "v", .value = "point(1, 0, 0)"}}};
}

} // namespace rend
