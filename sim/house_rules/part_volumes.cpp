// Two volumes at their common face, if they lie on different sides of a plane (thesis 7.3.3).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings part_volumes() {
  return {
      .name = "part-volumes",
      .about = "two volumes at their common face, if a plane runs between their middles",
      .left = "a*(0,1) b(0,1) a-3-b",
      .right = "a(0,1) b(0,1) a|3 b|3",
      .may_fold = true,
      .whens = {{.test = "(dot(mean(a, volume) - origin, n) >= 0 and dot(mean(b, volume) - origin, n) < 0) or "
                         "(dot(mean(a, volume) - origin, n) < 0 and dot(mean(b, volume) - origin, n) >= 0)",
                 .otherwise = "both lie on one side of the plane"}},
      .wheres = {{.name = "origin", .value = "point(1, 0, 0)"}, {.name = "n", .value = "point(1, 0, 0)"}}};
}

} // namespace rend
