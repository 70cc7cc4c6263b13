// fault: link_is_missing
// α3 of the new dart is not given.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "half creation",
    left{},
    right{node('a'), loop('a', 0, 1, 2), point('a', given(0))},
};
static_assert(well_formed(rule));

} // namespace rend
