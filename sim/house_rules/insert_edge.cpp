// An edge in a face, between two of its corners; the second hook is met first on the way by α0 from the first.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings insert_edge() {
  return {.name = "insert-edge",
          .about = "an edge in a face, between two of its corners; the second hook is met first on the way "
                   "by α0 from the first",
          .left = "a*(3) c(3) b*(3) d(3) a-1-c b-1-d",
          .right = "a(3) c(3) b(3) d(3) e(3) f(3) g(3) h(3) a-1-e c-1-f b-1-g d-1-h e-0-g f-0-h e-2-f g-2-h"};
}

} // namespace rend
