// Each face of a component of a sheet becomes one quad per corner (thesis figs. 3.42, 3.44).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings quarter_faces() {
  return {.name = "quarter-faces",
          .about = "each face of a component of a sheet becomes one quad per corner (thesis figs. 3.42, "
                   "3.44)",
          .left = "a*(0,1,2) a|3",
          .right = "a(_,1,2) b(_,_,2) c(2,_,_) d(2,1,_) a-0-b b-1-c c-0-d a|3 b|3 c|3 d|3",
          .sets = {{.node = "b", .position = "mean(a, edge)"}, {.node = "d", .position = "mean(a, face)"}}};
}

} // namespace rend
