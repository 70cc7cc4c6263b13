// A face of a sheet without neighbours (thesis fig. 3.47).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings remove_isolated_face() {
  return {.name = "remove-isolated-face",
          .about = "a face of a sheet without neighbours (thesis fig. 3.47)",
          .left = "a*(0,1) a|2,3",
          .right = ""};
}

} // namespace rend
