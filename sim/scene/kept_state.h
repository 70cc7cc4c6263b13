// A state that somebody wants to see, kept until it is certain that the steps which led to it will not be
// redone (sim/guard/guard.h). So pictures, exports and diagnostics show states of the run alone, none of an
// attempt that was discarded; and to be looked at alters no step.
//
// All kept states lie in the present stretch of steps: there are at most as many as it has, and one topology
// fits all. Where the stretch is redone, a state is copied again as the steps pass it: the last attempt counts.
#pragma once

#include "sim/guard/state_copy.h"
#include "sim/scene/energy_account.h"

#include <functional>

namespace rend {

struct KeptState {
  long step = 0; // steps done then
  std::function<void()> show;
  StateCopy state = {};
  EnergyAccount account = {}; // up to then
};

} // namespace rend
