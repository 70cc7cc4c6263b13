// fault: hook_drops_a_link
// A hook is a whole orbit.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "hook with gap",
    left{hook('a', {0, _}), loop('a', 2)},
    right{node('a', {0, _}), loop('a', 2)},
};
static_assert(well_formed(rule));

} // namespace rend
