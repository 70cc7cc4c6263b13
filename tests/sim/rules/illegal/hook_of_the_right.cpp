// fault: hook_is_on_the_right
// Only what is matched can be pointed at.
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
