// The surroundings of the bodies of a scene.
#pragma once

#include "sim/outside/load.h"
#include "sim/outside/mesh_obstacle.h"
#include "sim/outside/obstacle.h"

#include <optional>
#include <string>
#include <vector>

namespace rend {

struct Floor {
  double z = 0;                                          // [m]
  std::optional<double> friction = {}, restitution = {}; // coefficients; none: those of the body
  std::string name = {};                                 // empty: none
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
  std::vector<MeshObstacle> meshes = {};
  SettingsSource source = {};

  double gravity_share(double time) const { return ramp(time, over); } // 0 to 1
  Vec3 gravity_at(double time) const { return gravity_share(time) * gravity; }
  // besides the floor
  bool has_obstacles() const { return !spheres.empty() || !boxes.empty() || !meshes.empty(); }

  // Obstacles by number: 0 is the floor, whether there is one or not, then follow the spheres, then the boxes,
  // then the meshes.
  std::size_t number_of_sphere(std::size_t s) const { return 1 + s; }
  std::size_t number_of_box(std::size_t b) const { return 1 + spheres.size() + b; }
  std::size_t number_of_mesh(std::size_t m) const { return 1 + spheres.size() + boxes.size() + m; }
  std::size_t obstacles() const { return 1 + spheres.size() + boxes.size() + meshes.size(); }
  std::string called(std::size_t number) const; // "the floor", "sphere 1", "box 'table'", "obstacle 2"
};
template <> const Fields<World>& fields_of(); // those of its own

// UserError: what no reader has looked at, and what does not fit together.
void check_world(const World& world);

} // namespace rend
