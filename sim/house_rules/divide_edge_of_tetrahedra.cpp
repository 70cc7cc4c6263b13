// An edge gets a vertex at a share of its length, counted from the hook, and all tetrahedra around it become
// two each, parted by a face through that vertex and the opposite edge. Matter is not displaced: in linear
// tetrahedra neither strain nor elastic energy changes.
//
// At either end (a, A), in each tetrahedron abcd around the edge: a, b, c in the face abc, d, e, f in the face
// beyond its second edge; g to l are new, l at the opposite edge.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings divide_edge_of_tetrahedra() {
  return {.name = "divide-edge-of-tetrahedra",
          .about = "a vertex at a share of an edge, counted from the hook; each tetrahedron there becomes two",
          .left = "a*(2,3) b(_,3) c(_,3) d(1,_) e(_,_) f(0,_) A(2,3) B(_,3) C(_,3) D(1,_) E(_,_) F(0,_) "
                  "a-0-A c-1-C f-2-F a-1-b b-0-c b-2-d c-2-e d-0-e e-1-f A-1-B B-0-C B-2-D C-2-E D-0-E E-1-F",
          .right = "a(2,3) b(_,3) c(_,3) d(1,_) e(_,_) f(0,_) A(2,3) B(_,3) C(_,3) D(1,_) E(_,_) F(0,_) "
                   "g(2,3) h(_,3) i(1,_) j(_,3) k(_,_) l(0,_) G(2,3) H(_,3) I(1,_) J(_,3) K(_,_) L(0,_) "
                   "a-1-b b-0-c b-2-d c-2-e d-0-e e-1-f A-1-B B-0-C B-2-D C-2-E D-0-E E-1-F "
                   "a-0-g g-1-h h-0-j j-1-c h-2-i j-2-k i-0-k k-1-l l-2-f "
                   "A-0-G G-1-H H-0-J J-1-C H-2-I J-2-K I-0-K K-1-L L-2-F i-3-I k-3-K l-3-L",
          .sets = {{.node = "g", .position = "lerp(a, A, share)"}},
          .whens = {{.test = "share > 0 and share < 1", .otherwise = "the share is not between 0 and 1"}},
          .wheres = {{.name = "share", .value = "0.5"}}};
}

} // namespace rend
