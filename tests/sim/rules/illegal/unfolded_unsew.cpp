// fault: cycle_is_broken
// α2 opens at one end of the edge only.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "unfolded unsew",
    left{hook('a'), node('b'), arc('a', 2, 'b')},
    right{node('a'), node('b'), loop('a', 2), loop('b', 2)},
};
static_assert(well_formed(rule));

} // namespace rend
