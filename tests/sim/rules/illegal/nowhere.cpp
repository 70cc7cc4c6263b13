// fault: new_vertex_without_point
// The new middle vertex has no point.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "nowhere",
    left{hook('a', {0, 2, 3})},
    right{node('a', {_, 2, 3}), node('c', {1, 2, 3}), arc('a', 0, 'c')},
};
static_assert(well_formed(rule));

} // namespace rend
