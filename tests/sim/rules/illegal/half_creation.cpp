// fault: link_is_missing
// The new dart does not say what its α3 is.
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
