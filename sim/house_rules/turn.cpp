// Thesis fig. 3.52: all vertices of a component turn about an axis, by the formula of Rodrigues.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings turn() {
  return {
      .name = "turn",
      .about =
          "a component turns by an angle [radians] about an axis through the point centre (thesis fig. 3.52)",
      .left = "a*(0,1,2,3)",
      .right = "a(0,1,2,3)",
      .sets = {{.node = "a",
                .position = "centre + cos(angle)*arm + sin(angle)*cross(along_axis, arm) + "
                            "(1 - cos(angle))*dot(along_axis, arm)*along_axis"}},
      .wheres = {{.name = "angle", .value = "pi/6"},
                 {.name = "axis", .value = "point(0, 0, 1)"},
                 {.name = "centre", .value = "point(0, 0, 0)"}},
      .lets = {{.name = "along_axis", .value = "axis/norm(axis)"}, {.name = "arm", .value = "a - centre"}}};
}

} // namespace rend
