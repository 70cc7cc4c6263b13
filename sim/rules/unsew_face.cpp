#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// Opens a face between two volumes, however many sides it has. Thesis fig. 7.5, one dimension up.
//
//   a <0,1> ─3─ b <0,1>   →   a <0,1> ↺3    b <0,1> ↺3
constexpr Rule unsew_face{
    "unsew face",
    left{hook('a', {0, 1}), node('b', {0, 1}), arc('a', 3, 'b')},
    right{node('a', {0, 1}), node('b', {0, 1}), loop('a', 3), loop('b', 3)},
};
static_assert(well_formed(unsew_face));

} // namespace rend
