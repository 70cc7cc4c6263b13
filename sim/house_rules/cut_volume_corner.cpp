// A face between the neighbours of a vertex of a volume, whose faces are triangles there: what lies beyond them
// becomes a volume of its own.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings cut_volume_corner() {
  return {.name = "cut-volume-corner",
          .about = "a face beyond the triangles at a corner of a volume, which it cuts off",
          .left = "a*(1,2) b(_,2) c(0,_) d(0,_) a-0-b b-1-c c-2-d",
          .right = "a(1,2) b(_,2) c(0,_) d(0,_) g(0,1) h(0,1) a-0-b b-1-c c-2-g g-3-h h-2-d"};
}

} // namespace rend
