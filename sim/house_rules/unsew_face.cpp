// Two volumes at their common face (thesis fig. 7.6).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings unsew_face() {
  return {.name = "unsew-face",
          .about = "two volumes at their common face (thesis fig. 7.6)",
          .left = "a*(0,1) b(0,1) a-3-b",
          .right = "a(0,1) b(0,1) a|3 b|3",
          .may_fold = true};
}

} // namespace rend
