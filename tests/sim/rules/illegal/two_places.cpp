// fault: new_vertex_with_two_points
// c and d are one vertex.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "two places",
    left{hook('a', {0}), loop('a', 1, 3)},
    right{node('a', {0}), node('b', {_}), node('c', {_}), node('d', {0}), arc('a', 1, 'b'), arc('b', 0, 'c'),
          arc('c', 1, 'd'), loop('a', 3), loop('b', 2, 3), loop('c', 2, 3), loop('d', 2, 3),
          point('c', translated('a')), point('d', translated('a'))},
};
static_assert(well_formed(rule));

} // namespace rend
