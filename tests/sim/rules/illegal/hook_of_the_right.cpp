// fault: hook_is_on_the_right
// Only matched nodes can be hooks.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "hook of the right",
    left{hook('a', {0}), loop('a', 2)},
    right{hook('a', {0}), loop('a', 2)},
};
static_assert(well_formed(rule));

} // namespace rend
