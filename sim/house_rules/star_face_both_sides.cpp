// The same for both sides of a face of a solid.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings star_face_both_sides() {
  return {.name = "star-face-both-sides",
          .about = "the same for both sides of a face of a solid",
          .left = "a*(0,1,3)",
          .right = "a(0,_,3) b(_,2,3) c(1,2,3) a-1-b b-0-c",
          .sets = {{.node = "c", .position = "mean(a, face)"}}};
}

} // namespace rend
