// Two faces along an edge: dart to dart, and their far ends (thesis fig. 3.20).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings sew_edges() {
  return {.name = "sew-edges",
          .about = "two faces along an edge: dart to dart, and their far ends (thesis fig. 3.20)",
          .left = "a*(0) b*(0) a|2 b|2",
          .right = "a(0) b(0) a-2-b",
          .sets = {{.node = "a", .position = "a"}}};
}

} // namespace rend
