// Two pyramids that share their base: tetrahedra around the axis, which goes from the hook's apex to the
// other one. An octahedron is one with a base of four sides, along any of its three axes; the shortest one is
// taken.
//
// The middle of the volume is that of its base and of its apexes. So the distances from there compare the axes.
#include "sim/house_rules/house_rules.h"

namespace rend {

RuleSettings divide_bipyramid() {
  return {.name = "divide-bipyramid",
          .about =
              "tetrahedra around the axis of two pyramids on one base, if none through the base is shorter",
          .left = "a*(1,2) b(_,2) c(0,_) d(0,_) e(_,2) f(1,2) a-0-b b-1-c c-2-d d-1-e e-0-f",
          .right = "a(1,_) b(_,_) c(0,_) d(0,_) e(_,_) f(1,_) g(_,3) h(_,3) i(_,3) j(_,3) k(2,3) l(2,3) a-0-b "
                   "b-1-c c-2-d d-1-e e-0-f a-2-g b-2-h e-2-i f-2-j g-0-h h-1-i i-0-j j-1-k k-0-l l-1-g",
          .whens = {{.test = "norm(a - f) <= 2*norm(b - mean(a, volume))*(1 + 1e-9)",
                     .at = RuleWhenSettings::At::All,
                     .otherwise = "another axis is shorter"}}};
}

} // namespace rend
