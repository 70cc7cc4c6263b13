// Integrator::saved_state() into room that is there: what a scene keeps at every step, in case it is stopped
// within the step, asks for no memory.
#pragma once

#include <vector>

namespace rend {

class StateKeeper {
public:
  virtual ~StateKeeper() = default;
  virtual void keep_state(std::vector<double>& numbers) const = 0; // as many as saved_state() returns
};

} // namespace rend
