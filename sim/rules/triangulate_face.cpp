#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// A triangle on each side of a face, around a new vertex in its middle. Thesis figs. 3.22 to 3.29. The face is
// α3-free: of a sheet, or on the boundary of a solid.
//
//   a <0,1>   →   a <0,_> ─1─ b <_,2> ─0─ c <1,2>        all ↺3
constexpr Rule triangulate_face{
    "triangulate face",
    left{hook('a', {0, 1}), loop('a', 3)},
    right{node('a', {0, _}), node('b', {_, 2}), node('c', {1, 2}), arc('a', 1, 'b'), arc('b', 0, 'c'),
          loop('a', 3), loop('b', 3), loop('c', 3), point('c', mean('a', FaceOfVolume))},
};
static_assert(well_formed(triangulate_face));

} // namespace rend
