// Thesis fig. 3.32, without the colour: maps carry none.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings shape_quad() {
  constexpr const char* quad = "b c d e f g h a-0-b b-1-c c-0-d d-1-e e-0-f f-1-g g-0-h h-1-a";
  return {.name = "shape-quad",
          .about = "a face of four sides gets the corners p, q, r, s (thesis fig. 3.32)",
          .left = std::string("a* ") + quad,
          .right = std::string("a ") + quad,
          .sets = {{.node = "a", .position = "p"},
                   {.node = "c", .position = "q"},
                   {.node = "e", .position = "r"},
                   {.node = "g", .position = "s"}},
          .wheres = {{.name = "p", .value = "point(0, 0, 0)"},
                     {.name = "q", .value = "point(1.5, 0.25, 0)"},
                     {.name = "r", .value = "point(1.25, 1, 0)"},
                     {.name = "s", .value = "point(0.25, 1, 0)"}}};
}

} // namespace rend
