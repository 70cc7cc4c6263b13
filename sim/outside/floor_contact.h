// What a body does not pass through, and contact with the floor: a vertex that would pass it is put on it,
// loses what speed it has towards it, and is slowed along it by at most friction × that loss (Coulomb, as an
// impulse, at the end of the step). Vertices whose motion is prescribed pass it.
//
//   v_n' = max(v_n, 0),   v_t' = v_t max(0, 1 − μ (v_n' − v_n)/|v_t|),   x_t' = x_t + step (v_t' − v_t)
//
// The last keeps what sticks where it is. No energy is made: each impulse takes some away. What rests on the
// floor loses g × step each step, so that friction is μ times the weight, exact to a step's worth of motion.
#pragma once

#include "sim/base/settings.h"
#include "sim/integrate/system.h"

namespace rend {

struct ContactSettings {
  bool floor = false;
  bool obstacles = true;    // spheres and boxes; and the floor
  bool fragments = false;   // other fragments, and other bodies that ask for it
  bool self = false;        // faces of the same fragment as well; and `fragments`
  double thickness = 0.002; // [m], kept from all of them
  double friction = 0.5;    // coefficient, where the obstacle has none of its own
  SettingsSource source = {};

  bool faces() const { return obstacles || fragments || self; } // more than the floor
};
template <> const Fields<ContactSettings>& fields_of();

struct FloorContact {
  double height = 0;   // [m], the floor's plus the body's thickness
  double friction = 0; // coefficient

  void apply(State& next, double step) const; // step [s]
};

} // namespace rend
