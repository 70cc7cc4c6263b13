// A further volume on a face of the hull, whose far vertices lie away from a point.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings extrude_away() {
  return {
      .name = "extrude-away",
      .about =
          "a further volume on a face of the hull, larger by the factor 1 + t as seen from the point centre",
      .left = "a*(0,1) a|3",
      .right = "a(0,1) g(0,1) b(0,_) c(_,2) d(_,2) e(0,_) f(0,1) a-3-g g-2-b b-1-c c-0-d d-1-e e-2-f b|3 "
               "c|3 d|3 e|3 f|3",
      .sets = {{.node = "f", .position = "lerp(centre, a, 1 + t)"}},
      .wheres = {{.name = "centre", .value = "point(0, 0, 0)"}, {.name = "t", .value = "0.2"}}};
}

} // namespace rend
