// The surroundings of the bodies of a scene.
#pragma once

#include "sim/outside/load.h"
#include "sim/outside/obstacle.h"

#include <optional>
#include <vector>

namespace rend {

struct Floor {
  double z = 0;                        // [m]
  std::optional<double> friction = {}; // Coulomb's coefficient; none: that of the body
  SettingsSource source = {};
};
template <> const Fields<Floor>& fields_of();

struct World {
  Vec3 gravity{0, 0, -9.81}; // [m/s²], once it is whole
  double over = 0;           // [s]: gravity grows in proportion to time from 0 at time 0
  std::optional<Floor> floor = {};
  std::optional<Wind> wind = {};
  std::vector<Sphere> spheres = {};
  std::vector<Box> boxes = {};
  SettingsSource source = {};

  double gravity_share(double time) const { return ramp(time, over); } // 0 to 1
  Vec3 gravity_at(double time) const { return gravity_share(time) * gravity; }
  bool has_obstacles() const { return !spheres.empty() || !boxes.empty(); } // besides the floor
};
template <> const Fields<World>& fields_of(); // those of its own

// UserError: what no reader has looked at, and what does not fit together.
void check_world(const World& world);

} // namespace rend
