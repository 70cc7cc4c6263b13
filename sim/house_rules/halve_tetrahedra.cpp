// An edge is halved, and so are all tetrahedra around it.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings halve_tetrahedra() {
  return {.name = "halve-tetrahedra",
          .about = "an edge is halved, and so are all tetrahedra around it",
          .left = "a*(0,2,3) b(_,_,3) c(1,_,3) d(_,1,_) e(_,_,_) f(2,0,_) a-1-b b-0-c b-2-d c-2-e d-0-e "
                  "e-1-f",
          .right = "a(_,2,3) b(_,_,3) c(_,_,3) d(_,1,_) e(_,_,_) f(_,0,_) g(_,2,3) h(_,_,3) i(3,1,_) "
                   "j(_,_,3) k(3,_,_) l(3,0,_) a-1-b b-0-c b-2-d c-2-e d-0-e e-1-f a-0-g g-1-h h-0-j j-1-c "
                   "h-2-i j-2-k i-0-k k-1-l l-2-f",
          .sets = {{.node = "g", .position = "mean(a, edge)"}}};
}

} // namespace rend
