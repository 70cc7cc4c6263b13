// A face swept by an edge that has none (thesis figs. 3.38, 3.39).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings extrude_edge() {
  return {.name = "extrude-edge",
          .about = "a face swept by an edge that has none (thesis figs. 3.38, 3.39)",
          .left = "a*(0) a|1,2,3",
          .right = "a(0) b(_) c(_) d(0) a-1-b b-0-c c-1-d a|2,3 b|2,3 c|2,3 d|2,3",
          .sets = {{.node = "c", .position = "a + v"}},
          .wheres = {{.name = "v", .value = "point(0, 1, 0)"}}};
}

} // namespace rend
