#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// Removes a volume that is sewn to nothing (or a whole component of a sheet).
//
//   a <0,1,2> ↺3   →   ∅
constexpr Rule remove_isolated_volume{
    "remove isolated volume",
    left{hook('a', {0, 1, 2}), loop('a', 3)},
    right{},
};
static_assert(well_formed(remove_isolated_volume));

} // namespace rend
