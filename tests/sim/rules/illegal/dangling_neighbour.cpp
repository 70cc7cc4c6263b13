// fault: removed_node_dangles
// A face is removed though its α2 may lead to another.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "dangling neighbour",
    left{hook('a', {0, 1}), loop('a', 3)},
    right{},
};
static_assert(well_formed(rule));

} // namespace rend
