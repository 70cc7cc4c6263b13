// Two volumes along a face of as many sides.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings sew_faces() {
  return {.name = "sew-faces",
          .about = "two volumes along a face of as many sides",
          .left = "a*(0,1) b*(0,1) a|3 b|3",
          .right = "a(0,1) b(0,1) a-3-b",
          .sets = {{.node = "a", .position = "a"}}};
}

} // namespace rend
