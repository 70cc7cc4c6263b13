// An edge of a sheet gets a vertex at a share of its length, counted from the hook, and each triangle on its
// sides becomes two. Matter is not displaced: in linear triangles neither strain nor elastic energy changes.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings divide_edge_of_triangles() {
  return {.name = "divide-edge-of-triangles",
          .about = "a vertex at a share of an edge, counted from the hook; each triangle there becomes two",
          .left = "a*(2) b(_) c(_) A(2) B(_) C(_) a-0-A a-1-b b-0-c A-1-B B-0-C c-1-C "
                  "a|3 b|3 c|3 A|3 B|3 C|3",
          .right = "a(2) b(_) c(_) A(2) B(_) C(_) g(2) h(_) i(_) G(2) H(_) I(_) "
                   "a-1-b b-0-c A-1-B B-0-C a-0-g A-0-G g-1-h G-1-H h-2-H h-0-i H-0-I i-2-I i-1-c I-1-C "
                   "a|3 b|3 c|3 A|3 B|3 C|3 g|3 h|3 i|3 G|3 H|3 I|3",
          .sets = {{.node = "g", .position = "lerp(a, A, share)"}},
          .whens = {{.test = "share > 0 and share < 1", .otherwise = "the share is not between 0 and 1"}},
          .wheres = {{.name = "share", .value = "0.5"}}};
}

} // namespace rend
