// An edge from a vertex that has none to a second one (thesis fig. 3.37).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings extrude_vertex() {
  return {.name = "extrude-vertex",
          .about = "an edge from a vertex that has none to a second one (thesis fig. 3.37)",
          .left = "a* a|0,2,3",
          .right = "a b a-0-b a|2,3 b|1,2,3",
          .sets = {{.node = "b", .position = "a + v"}},
          .wheres = {{.name = "v", .value = "point(1, 0, 0)"}}};
}

} // namespace rend
