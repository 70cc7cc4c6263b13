#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// Cuts every face of a component into one quad per corner: b is at the midpoint of an edge, d at the centre of
// a face; c is at the same point as b, on the edge to d. All faces at once, so that no edge is cut on one side
// only. Thesis figs. 3.42, 3.44.
//
//   a <0,1,2>   →   a <_,1,2> ─0─ b <_,_,2> ─1─ c <2,_,_> ─0─ d <2,1,_>        all ↺3
constexpr Rule subdivide{
    "subdivide",
    left{hook('a', {0, 1, 2}), loop('a', 3)},
    right{node('a', {_, 1, 2}), node('b', {_, _, 2}), node('c', {2, _, _}), node('d', {2, 1, _}),
          arc('a', 0, 'b'), arc('b', 1, 'c'), arc('c', 0, 'd'), loop('a', 3), loop('b', 3), loop('c', 3),
          loop('d', 3), point('b', mean('a', Edge)), point('d', mean('a', FaceOfVolume))},
};
static_assert(well_formed(subdivide));

} // namespace rend
