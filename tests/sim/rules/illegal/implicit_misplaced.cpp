// fault: cycle_is_broken
// Triangulation whose b has its α2 where the hook has α0: the square with the explicit α0 to c stays open.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "implicit misplaced",
    left{hook('a', {0, 1}), loop('a', 3)},
    right{node('a', {0, _}), node('b', {2, _}), node('c', {1, 2}), arc('a', 1, 'b'), arc('b', 0, 'c'),
          loop('a', 3), loop('b', 3), loop('c', 3), point('c', mean('a', FaceOfVolume))},
};
static_assert(well_formed(rule));

} // namespace rend
