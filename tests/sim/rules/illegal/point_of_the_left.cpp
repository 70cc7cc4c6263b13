// fault: point_on_the_left
// Points are for new vertices.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "point of the left",
    left{hook('a', {0}), loop('a', 2), point('a', given(0))},
    right{node('a', {0}), loop('a', 2)},
};
static_assert(well_formed(rule));

} // namespace rend
