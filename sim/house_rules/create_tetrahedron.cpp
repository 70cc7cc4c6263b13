// A volume of four triangles, all 24 darts of it (thesis fig. 6.4).
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings create_tetrahedron() {
  return {.name = "create-tetrahedron",
          .about = "a volume of four triangles, all 24 darts of it (thesis fig. 6.4)",
          .left = "",
          .right = "a b c d e f g h i j k l m n o p q r s t u v w x a-0-c a-1-b a-2-g b-0-e b-2-m c-1-d "
                   "c-2-i d-0-f d-2-s e-1-f e-2-o f-2-u g-0-i g-1-h h-0-k h-2-n i-1-j j-0-l j-2-t k-1-l "
                   "k-2-q l-2-w m-0-o m-1-n n-0-q o-1-p p-0-r p-2-v q-1-r r-2-x s-0-u s-1-t t-0-w u-1-v "
                   "v-0-x w-1-x a|3 b|3 c|3 d|3 e|3 f|3 g|3 h|3 i|3 j|3 k|3 l|3 m|3 n|3 o|3 p|3 q|3 r|3 s|3 "
                   "t|3 u|3 v|3 w|3 x|3",
          .sets = {{.node = "a", .position = "p"},
                   {.node = "c", .position = "q"},
                   {.node = "e", .position = "r"},
                   {.node = "k", .position = "s"}},
          .wheres = {{.name = "p", .value = "point(0, 0, 0)"},
                     {.name = "q", .value = "point(1, 0, 0)"},
                     {.name = "r", .value = "point(0, 1, 0)"},
                     {.name = "s", .value = "point(0, 0, 1)"}}};
}

} // namespace rend
