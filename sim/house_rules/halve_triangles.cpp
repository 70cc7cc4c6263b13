// An edge of a sheet is halved, and so are the triangles on its sides.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings halve_triangles() {
  return {.name = "halve-triangles",
          .about = "an edge of a sheet is halved, and so are the triangles on its sides",
          .left = "a*(0,2) b(_,_) c(1,_) a-1-b b-0-c a|3 b|3 c|3",
          .right = "a(_,2) b(_,_) c(_,_) g(_,2) h(2,_) i(2,_) a-1-b b-0-c a-0-g g-1-h h-0-i i-1-c "
                   "a|3 b|3 c|3 g|3 h|3 i|3",
          .sets = {{.node = "g", .position = "mean(a, edge)"}}};
}

} // namespace rend
