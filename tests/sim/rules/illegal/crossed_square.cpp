// fault: cycle_is_broken
// Two explicit links whose square does not close: α0 a-b, c-d, but α2 a-c, b free.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "crossed square",
    left{hook('a'), node('b'), arc('a', 0, 'b'), loop('a', 2), loop('b', 2), hook('c'), node('d'),
         arc('c', 0, 'd'), loop('c', 2), loop('d', 2)},
    right{node('a'), node('b'), node('c'), node('d'), arc('a', 0, 'b'), arc('c', 0, 'd'), arc('a', 2, 'c'),
          loop('b', 2), loop('d', 2)},
};
static_assert(well_formed(rule));

} // namespace rend
