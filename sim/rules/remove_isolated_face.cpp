#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// Removes a face that is sewn to nothing. Thesis fig. 3.47.
//
//   a <0,1> ↺2,3   →   ∅
constexpr Rule remove_isolated_face{
    "remove isolated face",
    left{hook('a', {0, 1}), loop('a', 2, 3)},
    right{},
};
static_assert(well_formed(remove_isolated_face));

} // namespace rend
