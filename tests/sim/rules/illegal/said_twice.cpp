// fault: link_is_said_twice
// α2 is both free and an arc.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "said twice",
    left{hook('a', {0}), node('b', {0}), arc('a', 2, 'b'), loop('a', 2)},
    right{node('a', {0}), node('b', {0}), loop('a', 2), loop('b', 2)},
};
static_assert(well_formed(rule));

} // namespace rend
