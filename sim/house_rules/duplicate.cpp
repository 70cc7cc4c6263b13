// A second component like the first, moved by v (thesis table 2.1).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings duplicate() {
  return {.name = "duplicate",
          .about = "a second component like the first, moved by v (thesis table 2.1)",
          .left = "a*(0,1,2,3)",
          .right = "a(0,1,2,3) b(0,1,2,3)",
          .sets = {{.node = "b", .position = "a + v"}},
          .wheres = {{.name = "v", .value = "point(0, 0, 1)"}}};
}

} // namespace rend
