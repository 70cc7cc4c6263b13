// A pyramid on each face of a volume, around a vertex in its middle.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings star_volume() {
  return {.name = "star-volume",
          .about = "a pyramid on each face of a volume, around a vertex in its middle",
          .left = "a*(0,1,2)",
          .right = "a(0,1,_) b(0,_,3) c(_,2,3) d(1,2,3) a-2-b b-1-c c-0-d",
          .sets = {{.node = "d", .position = "mean(a, volume)"}}};
}

} // namespace rend
