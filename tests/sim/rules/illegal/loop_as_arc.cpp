// fault: arc_should_be_a_loop
// A free link must be written as a loop.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "loop as arc",
    left{hook('a', {0}), arc('a', 2, 'a')},
    right{node('a', {0}), loop('a', 2)},
};
static_assert(well_formed(rule));

} // namespace rend
