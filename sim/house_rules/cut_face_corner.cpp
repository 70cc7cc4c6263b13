// A triangle off a corner of a face, on both of its sides: an edge between the two next vertices.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings cut_face_corner() {
  return {.name = "cut-face-corner",
          .about = "an edge between the two neighbours of a corner of a face",
          .left = "a*(1,3) b(_,3) c(_,3) a-0-b b-1-c",
          .right = "a(1,3) b(_,3) c(_,3) d(0,3) e(0,3) a-0-b b-1-d d-2-e e-1-c"};
}

} // namespace rend
