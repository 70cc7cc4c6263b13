// Symplectic (semi-implicit) Euler, thesis 2.40: the velocity first, then the position with the new velocity.
//
//   v' = v + dt a(x, v),   x' = x + dt v'
//
// Order 1, stable up to 2/ω, and without damping its energy oscillates but does not drift.
#include "sim/integrate/euler.h"

namespace rend {

Scheme symplectic_euler() {
  return {.name = "symplectic",
          .what = "symplectic Euler: velocity first, then position",
          .order = 1,
          .evaluations = 1,
          .limit = &limit_symplectic,
          .make = &make_integrator<Euler<MovesBy::NewVelocity>>,
          .shadow = 0.5,
          .contact = ContactIn::Result};
}

} // namespace rend
