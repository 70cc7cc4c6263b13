#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// Sews two faces along an edge: the first hook to the second, and their far ends to each other. Thesis fig.
// 3.20. Merged vertices keep the point of their smallest dart.
//
//   a <0> ↺2    b <0> ↺2   →   a <0> ─2─ b <0>
constexpr Rule sew_edges{
    "sew edges",
    left{hook('a', {0}), hook('b', {0}), loop('a', 2), loop('b', 2)},
    right{node('a', {0}), node('b', {0}), arc('a', 2, 'b')},
};
static_assert(well_formed(sew_edges));

} // namespace rend
