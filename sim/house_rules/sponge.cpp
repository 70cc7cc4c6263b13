// Each hexahedron of a component becomes 20, of a third of its size: those in the middle and in the middle of
// its faces are left out (a Menger sponge).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings sponge() {
  return {.name = "sponge",
          .about = "each hexahedron of a component becomes 20, of a third of its size: those in the middle "
                   "and in the middle of its faces are left out (a Menger sponge)",
          .left = "a*(0,1,2,3)",
          .right = "a(_,1,2,3) b(_,_,2,3) c(_,_,_,3) d(_,_,1,_) e(_,1,_,3) f(_,_,_,_) g(_,2,_,_) h(_,2,1,_) "
                   "i(_,_,1,_) j(_,_,_,3) k(0,_,2,3) l(_,_,_,_) m(_,_,_,3) n(_,_,_,_) o(_,_,_,_) p(0,_,_,3) "
                   "q(0,_,_,_) r(_,_,1,_) s(_,_,_,_) t(0,_,2,_) a-0-b b-1-c c-0-e c-2-d d-0-f d-3-i e-2-f "
                   "f-1-g f-3-l g-0-h g-3-n h-3-r i-0-l i-2-j j-0-m j-1-k l-1-n l-2-m m-1-p n-0-r n-2-o "
                   "o-0-s o-1-q p-2-q r-2-s s-1-t o|3 q|3 s|3 t|3",
          .sets = {{.node = "b", .position = "1/3*a + 2/3*mean(a, edge)"},
                   {.node = "e", .position = "1/3*a + 2/3*mean(a, face)"},
                   {.node = "h", .position = "1/3*a + 2/3*mean(a, volume)"}}};
}

} // namespace rend
