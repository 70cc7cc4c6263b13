// fault: point_from_unknown_node
// z is not matched.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "copy of nothing",
    left{},
    right{node('a'), loop('a', 0, 1, 2, 3), point('a', copy('z'))},
};
static_assert(well_formed(rule));

} // namespace rend
