// Thesis fig. 3.31: the left graph names all eight darts of a quad, so that nothing else matches.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings move_quad_corner() {
  constexpr const char* quad = "b c d e f g h a-0-b b-1-c c-0-d d-1-e e-0-f f-1-g g-0-h h-1-a";
  return {.name = "move-quad-corner",
          .about = "a corner of a face of four sides moves by v (thesis fig. 3.31)",
          .left = std::string("a* ") + quad,
          .right = std::string("a ") + quad,
          .sets = {{.node = "a", .position = "a + v"}},
          .wheres = {{.name = "v", .value = "point(0.25, 0.25, 0)"}}};
}

} // namespace rend
