// Each volume of a component becomes one hexahedron per corner: 8 of a hexahedron, 6 of a prism, 4 of a
// tetrahedron.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings divide_volumes() {
  return {.name = "divide-volumes",
          .about = "each volume of a component becomes one hexahedron per corner: 8 of a hexahedron, 6 of a "
                   "prism, 4 of a tetrahedron",
          .left = "a*(0,1,2,3)",
          .right = "a(_,1,2,3) b(_,_,2,3) c(_,_,_,3) d(_,1,_,3) e(3,_,1,_) f(3,_,_,_) g(3,2,_,_) h(3,2,1,_) "
                   "a-0-b b-1-c c-0-d c-2-e d-2-f e-0-f f-1-g g-0-h",
          .sets = {{.node = "b", .position = "mean(a, edge)"},
                   {.node = "d", .position = "mean(a, face)"},
                   {.node = "h", .position = "mean(a, volume)"}}};
}

} // namespace rend
