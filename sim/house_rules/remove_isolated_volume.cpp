// A volume without neighbours.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings remove_isolated_volume() {
  return {.name = "remove-isolated-volume",
          .about = "a volume without neighbours (thesis fig. 7.7)",
          .left = "a*(0,1,2) a|3",
          .right = ""};
}

} // namespace rend
