// A vertex moves by v.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings move() {
  return {.name = "move",
          .about = "a vertex moves by v",
          .left = "a*(1,2,3)",
          .right = "a(1,2,3)",
          .sets = {{.node = "a", .position = "a + v"}},
          .wheres = {{.name = "v", .value = "point(0, 0, 0)"}}};
}

} // namespace rend
