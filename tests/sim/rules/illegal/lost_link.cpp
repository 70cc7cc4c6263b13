// fault: kept_node_loses_a_link
// α2 of a kept dart is matched, then forgotten.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "lost link",
    left{hook('a', {0}), loop('a', 2)},
    right{node('a', {0})},
};
static_assert(well_formed(rule));

} // namespace rend
