// A vertex of one dart, free in all links (thesis fig. 3.36).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings create_vertex() {
  return {.name = "create-vertex",
          .about = "a vertex of one dart, free in all links (thesis fig. 3.36)",
          .left = "",
          .right = "a a|0,1,2,3",
          .sets = {{.node = "a", .position = "p"}},
          .wheres = {{.name = "p", .value = "point(0, 0, 0)"}}};
}

} // namespace rend
