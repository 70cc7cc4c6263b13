// A face of three sides (thesis fig. 3.46).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings create_triangle() {
  return {
      .name = "create-triangle",
      .about = "a face of three sides (thesis fig. 3.46)",
      .left = "",
      .right = "a b c d e f a-0-b b-1-c c-0-d d-1-e e-0-f f-1-a a|2,3 b|2,3 c|2,3 d|2,3 e|2,3 f|2,3",
      .sets = {{.node = "a", .position = "p"}, {.node = "c", .position = "q"}, {.node = "e", .position = "r"}},
      .wheres = {{.name = "p", .value = "point(0, 0, 0)"},
                 {.name = "q", .value = "point(1, 0, 0)"},
                 {.name = "r", .value = "point(0, 1, 0)"}}};
}

} // namespace rend
