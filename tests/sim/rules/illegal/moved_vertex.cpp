// fault: point_of_a_kept_vertex
// b belongs to the vertex of a, which has a point already.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "moved vertex",
    left{hook('a'), loop('a', 1, 3)},
    right{node('a'), node('b'), arc('a', 1, 'b'), loop('a', 3), loop('b', 0, 2, 3), point('b', given(0))},
};
static_assert(well_formed(rule));

} // namespace rend
