#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// A vertex in the middle of an edge on the border, the two ends matched one by one. Thesis figs. 3.18, 3.19.
//
//   a ─0─ b   →   a ─0─ c ─1─ d ─0─ b        all ↺2,3
constexpr Rule insert_vertex_border{
    "insert vertex on the border",
    left{hook('a'), node('b'), arc('a', 0, 'b'), loop('a', 2, 3), loop('b', 2, 3)},
    right{node('a'), node('b'), node('c'), node('d'), arc('a', 0, 'c'), arc('c', 1, 'd'), arc('d', 0, 'b'),
          loop('a', 2, 3), loop('b', 2, 3), loop('c', 2, 3), loop('d', 2, 3), point('c', mean('a', Edge))},
};
static_assert(well_formed(insert_vertex_border));

} // namespace rend
