// Steps within which contact acts (sim/contact/contacts.h): those of velocity Verlet, divided.
//
//   drift    u = v + h/2 a(x, v),   x' = x + h u
//   contact  changes u by Δu and x' by h Δu
//   kick     v' = u + h/2 a(x', w)                     w: v' predicted, for damping
//
// Without the kick, the state is *staggered*: its velocities are those of the middle of the step. From such a
// state the next step begins with u' = u + h a(x', u): symplectic Euler. So it goes on as long as something
// touches; the kick ends it. An impulse m Δu changes what is kept, for linear forces exactly,
//
//   K + U + h/2 Σ F·u of a staggered state,   K + U − h²/8 Σ F²/m of another   (the same number)
//
// by m Δu·(u⁻ + u)/2, where u⁻ is the velocity of the step before.
#pragma once

#include "sim/integrate/system.h"

namespace rend {

// `force` [N]: of `now`, with its loads. Leaves x' and u in `next`.
void drift(System& system, double time, double step, const StateView& now, const Record* force, State& next);

// Of the shadow energy between such steps: the share of h² Σ F²/m that is subtracted (Scheme::force_shadow).
inline constexpr double leapfrog_shadow = 0.125;

// Of `next` as drift() and contact left it. `force`: scratch.
void kick(System& system, double time, double step, const StateView& now, State& next,
          std::vector<Record>& force);

} // namespace rend
