// fault: cycle_is_broken
// The new names α1, α3 of b would commute; the hook's α0, α1 that they copy do not.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "renamed cycle",
    left{hook('a', {0, 1})},
    right{node('a', {0, 1}), node('b', {1, 3}), loop('b', 0, 2), point('b', copy('a'))},
};
static_assert(well_formed(rule));

} // namespace rend
