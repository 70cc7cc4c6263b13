// fault: hook_is_missing
// Nothing determines which dart b is.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "no hook",
    left{hook('a', {0}), node('b', {0}), loop('a', 2), loop('b', 2)},
    right{node('a', {0}), node('b', {0}), arc('a', 2, 'b')},
};
static_assert(well_formed(rule));

} // namespace rend
