#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// The same for a face between two volumes, whose two sides change alike.
//
//   a <0,1,3>   →   a <0,_,3> ─1─ b <_,2,3> ─0─ c <1,2,3>
constexpr Rule triangulate_face_both_sides{
    "triangulate face on both sides",
    left{hook('a', {0, 1, 3})},
    right{node('a', {0, _, 3}), node('b', {_, 2, 3}), node('c', {1, 2, 3}), arc('a', 1, 'b'), arc('b', 0, 'c'),
          point('c', mean('a', Face))},
};
static_assert(well_formed(triangulate_face_both_sides));

} // namespace rend
