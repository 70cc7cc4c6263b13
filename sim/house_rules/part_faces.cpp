// Two faces at their common edge, if they lie on different sides of a plane (thesis 7.3.3).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings part_faces() {
  return {.name = "part-faces",
          .about = "two faces at their common edge, if a plane runs between their middles",
          .left = "a*(0) b(0) a-2-b",
          .right = "a(0) b(0) a|2 b|2",
          .may_fold = true,
          .whens = {{.test = "(dot(mean(a, face) - origin, n) >= 0 and dot(mean(b, face) - origin, n) < 0) or "
                             "(dot(mean(a, face) - origin, n) < 0 and dot(mean(b, face) - origin, n) >= 0)",
                     .otherwise = "both lie on one side of the plane"}},
          .wheres = {{.name = "origin", .value = "point(1, 0, 0)"}, {.name = "n", .value = "point(1, 0, 0)"}}};
}

} // namespace rend
