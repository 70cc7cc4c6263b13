// Two faces at their common edge (thesis figs. 3.48, 7.5).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings unsew_edge() {
  return {.name = "unsew-edge",
          .about = "two faces at their common edge (thesis figs. 3.48, 7.5)",
          .left = "a*(0) b(0) a-2-b",
          .right = "a(0) b(0) a|2 b|2",
          .may_fold = true};
}

} // namespace rend
