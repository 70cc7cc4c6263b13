// A minimal time loop: forces, a scheme, and fixed vertices, without laws, loads, contacts, probes, answers,
// profile or guard. The difference to the loop of a scene is the overhead of unused features.
#pragma once

#include "sim/scene/scene.h"

namespace rend {

class MinimalLoop {
public:
  // Continues from the scene's state, which it changes; the scene must make no steps meanwhile. CHECK:
  // beyond_minimal() is empty.
  explicit MinimalLoop(Scene& scene);
  ~MinimalLoop();
  void step();

private:
  struct MinimalBody;
  Scene* scene_;
  std::vector<std::unique_ptr<MinimalBody>> bodies_;
  long steps_ = 0;
};

// A feature of the scene that this loop does not have; empty: none.
std::string beyond_minimal(const Scene& scene);

} // namespace rend
