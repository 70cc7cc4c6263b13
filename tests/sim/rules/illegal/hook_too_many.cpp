// fault: component_has_two_hooks
// b follows from a already.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "hook too many",
    left{hook('a', {0}), hook('b', {0}), arc('a', 2, 'b')},
    right{node('a', {0}), node('b', {0}), loop('a', 2), loop('b', 2)},
};
static_assert(well_formed(rule));

} // namespace rend
