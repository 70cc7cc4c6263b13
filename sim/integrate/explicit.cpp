// Explicit Euler, thesis 2.36:   v' = v + dt a(x, v),   x' = x + dt v
//
// Order 1. Without damping it gains energy at any step; with it, stable up to 2ξ/ω.
#include "sim/integrate/euler.h"

namespace rend {

Scheme explicit_euler() {
  return {.name = "explicit",
          .what = "explicit Euler: only stable with damping",
          .order = 1,
          .evaluations = 1,
          .limit = &limit_by_drag,
          .make = &make_integrator<Euler<MovesBy::OldVelocity>>};
}

} // namespace rend
