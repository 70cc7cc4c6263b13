// A face of a sheet with faces on all sides (thesis fig. 3.50).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings remove_inner_face() {
  return {.name = "remove-inner-face",
          .about = "a face of a sheet with faces on all sides (thesis fig. 3.50)",
          .left = "a*(0,1) b(0,_) a-2-b a|3",
          .right = "b(0,_) b|2"};
}

} // namespace rend
