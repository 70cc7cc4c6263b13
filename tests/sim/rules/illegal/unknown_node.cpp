// fault: node_is_unknown
// The arc leads to a node that does not exist.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "unknown node",
    left{hook('a', {0}), arc('a', 2, 'b')},
    right{node('a', {0}), loop('a', 2)},
};
static_assert(well_formed(rule));

} // namespace rend
