// A vertex in the middle of an edge of the border, its ends matched one by one (thesis figs. 3.18, 3.19).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings insert_vertex_border() {
  return {.name = "insert-vertex-border",
          .about = "a vertex in the middle of an edge of the border, its ends matched one by one (thesis "
                   "figs. 3.18, 3.19)",
          .left = "a* b a-0-b a|2,3 b|2,3",
          .right = "a b c d a-0-c c-1-d d-0-b a|2,3 b|2,3 c|2,3 d|2,3",
          .sets = {{.node = "c", .position = "mean(a, edge)"}}};
}

} // namespace rend
