// fault: kept_node_gains_a_link
// α2 of a kept dart is set, but was not matched.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "gained link",
    left{hook('a', {0})},
    right{node('a', {0}), loop('a', 2)},
};
static_assert(well_formed(rule));

} // namespace rend
