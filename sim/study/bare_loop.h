// The time loop of a scene that knows nothing but forces, a scheme, and what is fixed: no laws, loads,
// contacts, probes, answers, samples of the clock, nor looks at how it goes. What the loop of every scene costs
// above this is what all that is not asked for costs.
#pragma once

#include "sim/scene/scene.h"

namespace rend {

class BareLoop {
public:
  // Goes on from the scene's state, which it changes; the scene makes no step meanwhile. CHECK: bare_enough().
  explicit BareLoop(Scene& scene);
  ~BareLoop();
  void step();

private:
  struct Bare;
  Scene* scene_;
  std::vector<std::unique_ptr<Bare>> bodies_;
  long steps_ = 0;
};

// Empty where the scene has nothing that the loop does not know; else what it has.
std::string more_than_bare(const Scene& scene);

} // namespace rend
