#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// Separates two volumes at their common face, of any number of sides. Thesis fig. 7.5, in one dimension more.
//
//   a <0,1> ─3─ b <0,1>   →   a <0,1> ↺3    b <0,1> ↺3
constexpr Rule unsew_face{
    "unsew face",
    left{hook('a', {0, 1}), node('b', {0, 1}), arc('a', 3, 'b')},
    right{node('a', {0, 1}), node('b', {0, 1}), loop('a', 3), loop('b', 3)},
};
static_assert(well_formed(unsew_face));

} // namespace rend
