// A minimal time loop: forces, a scheme, and fixed vertices, without laws, loads, contacts, probes, answers,
// profile or guard. The difference to the loop of a scene is the overhead of unused features.
#pragma once

#include "sim/scene/scene.h"

namespace rend {

class BareLoop {
public:
  // Continues from the scene's state, which it changes; the scene must make no steps meanwhile. CHECK:
  // more_than_bare() is empty.
  explicit BareLoop(Scene& scene);
  ~BareLoop();
  void step();

private:
  struct Bare;
  Scene* scene_;
  std::vector<std::unique_ptr<Bare>> bodies_;
  long steps_ = 0;
};

// A feature of the scene that this loop does not have; empty: none.
std::string more_than_bare(const Scene& scene);

} // namespace rend
