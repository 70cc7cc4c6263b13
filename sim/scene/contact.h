// Contact with the floor: a vertex that would pass it is put on it, loses what speed it has towards it, and is
// slowed along it by at most friction × that loss (Coulomb, as an impulse, at the end of the step). Vertices
// whose motion is prescribed pass it.
#pragma once

#include "sim/integrate/system.h"

namespace rend {

struct FloorContact {
  double height = 0;   // [m], the floor's plus the body's thickness
  double friction = 0; // coefficient

  void apply(State& next) const;
};

} // namespace rend
