// fault: labels_differ_in_length
// Positions would not correspond.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "short label",
    left{hook('a', {0, 1}), node('b', {0}), arc('a', 3, 'b')},
    right{node('a', {0, 1}), node('b', {0}), loop('a', 3), loop('b', 3)},
};
static_assert(well_formed(rule));

} // namespace rend
