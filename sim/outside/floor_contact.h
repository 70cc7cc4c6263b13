// Contact settings of a body, and contact with the floor: a vertex that would penetrate it is put on it, its
// normal velocity is set to 0, and its tangential velocity is reduced by at most friction × that change
// (Coulomb friction as an impulse at the end of the step). Prescribed vertices ignore the floor.
//
//   v_n' = max(v_n, 0),   v_t' = v_t max(0, 1 − μ (v_n' − v_n)/|v_t|),   x_t' = x_t + step (v_t' − v_t)
//
// A vertex that was lower at the start of the step, because it starts on the floor itself or was released
// below, is lifted gradually (way_out() in impact.h), without velocity.
//
// The last keeps sticking vertices in place. Each impulse dissipates energy. A vertex at rest on the floor gets
// the impulse g × step in each step, so that friction is μ times the weight, up to one step's motion.
#pragma once

#include "sim/base/settings.h"
#include "sim/embedding/slot_table.h"
#include "sim/integrate/system.h"

namespace rend {

struct ContactSettings {
  bool floor = false;
  bool obstacles = true;    // spheres and boxes; and the floor
  bool fragments = false;   // other fragments, and other bodies that ask for it
  bool self = false;        // faces of the same fragment as well; and `fragments`
  double thickness = 0.002; // [m], kept from all of them
  double friction = 0.5;    // coefficient, where the obstacle has none of its own
  enum class Overlap { Refuse, Push } overlap = Overlap::Refuse; // what starts inside something
  SettingsSource source = {};

  bool push() const { return overlap == Overlap::Push; }
  bool faces() const { return obstacles || fragments || self; } // more than the floor
};
template <> const Fields<ContactSettings>& fields_of();

// A vertex as it was before contact changed it.
struct TouchedVertex {
  Slot vertex = 0;
  Record position, velocity; // [m], [m/s]
};

struct FloorContact {
  double height = 0;   // [m], the floor's plus the body's thickness
  double friction = 0; // coefficient

  // `from` [m]: at the start of the step, one per vertex slot; step [s]. Vertices that it changes are added to
  // `touched`, as they were before.
  void apply(const Record* from, State& next, double step, std::vector<TouchedVertex>& touched) const;
};

} // namespace rend
