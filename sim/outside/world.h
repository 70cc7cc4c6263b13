// What surrounds the bodies of a scene.
#pragma once

#include "sim/outside/obstacle.h"
#include "sim/outside/wind.h"

#include <optional>
#include <vector>

namespace rend {

struct World {
  Vec3 gravity{0, 0, -9.81};            // [m/s²]
  std::optional<double> floor;          // z [m]
  std::optional<double> floor_friction; // Coulomb's coefficient; none: that of the body
  std::optional<Wind> wind;
  std::vector<Sphere> spheres;
  std::vector<Box> boxes;

  bool has_obstacles() const { return !spheres.empty() || !boxes.empty(); } // besides the floor
};

} // namespace rend
