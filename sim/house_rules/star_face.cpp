// A triangle on each side of a face, around a vertex in its middle (thesis figs. 3.22 to 3.29).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings star_face() {
  return {.name = "star-face",
          .about = "a triangle on each side of a face, around a vertex in its middle (thesis figs. 3.22 to "
                   "3.29)",
          .left = "a*(0,1) a|3",
          .right = "a(0,_) b(_,2) c(1,2) a-1-b b-0-c a|3 b|3 c|3",
          .sets = {{.node = "c", .position = "mean(a, face)"}}};
}

} // namespace rend
