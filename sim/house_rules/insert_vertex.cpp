// A vertex in the middle of an edge, for all faces and volumes around it.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings insert_vertex() {
  return {.name = "insert-vertex",
          .about = "a vertex in the middle of an edge, for all faces and volumes around it",
          .left = "a*(0,2,3)",
          .right = "a(_,2,3) c(1,2,3) a-0-c",
          .sets = {{.node = "c", .position = "mean(a, edge)"}}};
}

} // namespace rend
