#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// Removes a face of a sheet and frees the edges of its neighbours. Every side must be sewn to another face: b
// is one dart per side, its α1 (the label's `_`) is not matched. Thesis fig. 3.50.
//
//   a <0,1> ─2─ b <0,_>   →   b <0,_> ↺2        a ↺3
constexpr Rule remove_inner_face{
    "remove inner face",
    left{hook('a', {0, 1}), node('b', {0, _}), arc('a', 2, 'b'), loop('a', 3)},
    right{node('b', {0, _}), loop('b', 2)},
};
static_assert(well_formed(remove_inner_face));

} // namespace rend
