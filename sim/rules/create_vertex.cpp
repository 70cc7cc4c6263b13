#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// A vertex of one dart, free in all links. Thesis fig. 3.36.
//
//   ∅   →   a ↺0,1,2,3
constexpr Rule create_vertex{
    "create vertex",
    left{},
    right{node('a'), loop('a', 0, 1, 2, 3), point('a', given(0))},
};
static_assert(well_formed(create_vertex));

} // namespace rend
