#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// A second vertex, and the edge to it. Thesis fig. 3.37. α1 of the first vertex may lead to an existing edge:
// the rule does not constrain it.
//
//   a ↺0,2,3   →   a ─0─ b ↺1        both ↺2,3
constexpr Rule create_edge{
    "create edge",
    left{hook('a'), loop('a', 0, 2, 3)},
    right{node('a'), node('b'), arc('a', 0, 'b'), loop('a', 2, 3), loop('b', 1, 2, 3), point('b', given(0))},
};
static_assert(well_formed(create_edge));

} // namespace rend
