// A face of four sides becomes two triangles.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings halve_quad() {
  return {.name = "halve-quad",
          .about = "a face of four sides becomes two triangles",
          .left = "a*(3) b(3) c(3) d(3) e(3) f(3) g(3) h(3) a-0-b b-1-c c-0-d d-1-e e-0-f f-1-g g-0-h h-1-a",
          .right = "a(3) b(3) c(3) d(3) e(3) f(3) g(3) h(3) i(3) j(3) k(3) l(3) a-0-b b-1-c c-0-d e-0-f "
                   "f-1-g g-0-h a-1-i i-0-j j-1-d h-1-k k-0-l l-1-e i-2-k j-2-l"};
}

} // namespace rend
