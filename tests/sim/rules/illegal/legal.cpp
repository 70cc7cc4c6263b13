// fault: none
// The control: what is well formed compiles.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "legal",
    left{hook('a', {0}), node('b', {0}), arc('a', 2, 'b')},
    right{node('a', {0}), node('b', {0}), loop('a', 2), loop('b', 2)},
};
static_assert(well_formed(rule));

} // namespace rend
