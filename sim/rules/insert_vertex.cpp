#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// A vertex in the middle of an edge, for all faces and volumes around it at once: the hook is the orbit
// <0,2,3>, in a sheet <0,2>.
//
//   a <0,2,3>   →   a <_,2,3> ─0─ c <1,2,3>
constexpr Rule insert_vertex{
    "insert vertex",
    left{hook('a', {0, 2, 3})},
    right{node('a', {_, 2, 3}), node('c', {1, 2, 3}), arc('a', 0, 'c'), point('c', mean('a', Edge))},
};
static_assert(well_formed(insert_vertex));

} // namespace rend
