// fault: node_is_named_twice
// Two nodes are called a.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "namesakes",
    left{},
    right{node('a'), node('a'), loop('a', 0, 1, 2, 3), point('a', given(0))},
};
static_assert(well_formed(rule));

} // namespace rend
