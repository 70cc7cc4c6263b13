#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// Separates two faces at their common edge. Each node stands for an orbit <0>: both ends of the edge. Thesis
// figs. 3.48, 7.5.
//
//   a <0> ─2─ b <0>   →   a <0> ↺2    b <0> ↺2
constexpr Rule unsew_edge{
    "unsew edge",
    left{hook('a', {0}), node('b', {0}), arc('a', 2, 'b')},
    right{node('a', {0}), node('b', {0}), loop('a', 2), loop('b', 2)},
};
static_assert(well_formed(unsew_edge));

} // namespace rend
