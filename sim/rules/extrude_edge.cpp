#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// A face swept by an edge without face. The nodes stand for orbits <0>: b and c are the sides at the edge's two
// ends, d the opposite edge. Thesis figs. 3.38, 3.39.
//
//   a <0> ↺1   →   a <0> ─1─ b <_> ─0─ c <_> ─1─ d <0>
constexpr Rule extrude_edge{
    "extrude edge",
    left{hook('a', {0}), loop('a', 1, 3)},
    right{node('a', {0}), node('b', {_}), node('c', {_}), node('d', {0}), arc('a', 1, 'b'), arc('b', 0, 'c'),
          arc('c', 1, 'd'), loop('a', 3), loop('b', 2, 3), loop('c', 2, 3), loop('d', 2, 3),
          point('c', translated('a'))},
};
static_assert(well_formed(extrude_edge));

} // namespace rend
