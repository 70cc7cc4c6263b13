// Counts where a change of the list was not possible, as rules do themselves (rule_change.h), so that a run can
// tell why a law never tears although its criterion exceeds the threshold.
#pragma once

#include "sim/fracture/change.h"

namespace rend {

// The same change, with a memory that counts. One for each law.
std::shared_ptr<const ChangeType> counted(const ChangeType& change);

} // namespace rend
