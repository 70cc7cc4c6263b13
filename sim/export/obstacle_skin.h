// The surfaces of obstacles as polygons, for programs that know no spheres.
//
// A box is six quads. A sphere is a cube of 6 n² quads whose vertices are projected onto it, at equal angles
// on each side of the cube: it is watertight, has no poles, and deviates from the sphere by less than 0.4 %
// of the radius. A mesh is its triangles. All turn as they are prescribed to. The floor is a plane without
// end and is not among them.
#pragma once

#include "sim/export/skin.h"
#include "sim/outside/world.h"

#include <span>
#include <string>
#include <vector>

namespace rend {

// One obstacle in one state of a scene.
struct ObstacleSkin {
  std::string name;         // "sphere 1", "box 2", "obstacle 1": numbered from 1, in the order of the preset
  std::vector<Vec3> start;  // [m], where its points are at time 0
  std::vector<Vec3> points; // [m]
  std::vector<Vec3> velocities; // [m/s], one per point
  // Points of its faces, counter-clockwise as seen from outside; the triangles are those of a mesh.
  std::vector<std::array<std::int32_t, 4>> quads;
  std::vector<std::array<std::int32_t, 3>> triangles;

  // Calls f(points) for each face.
  template <class F> void each_face(const F& f) const {
    for (const auto& quad : quads) f(std::span<const std::int32_t>(quad));
    for (const auto& triangle : triangles) f(std::span<const std::int32_t>(triangle));
  }
};

// Of all spheres, then of all boxes, then of all meshes, at `time` [s], which is that of the state.
std::vector<ObstacleSkin> obstacle_skins(const World& world, double time);

// Maps the points of a sphere at time 0 to where they are at `time` [s]; the centre of one that follows no
// keys is that of the current state.
Pose pose_of(const Sphere& sphere, double time);

// Appends them as further bodies, in the same order: their `vertex` counts from 0 in each, they are of no
// fragment (-1) and no element (0), and have no stress.
void add_obstacles(Skin& skin, const World& world);

} // namespace rend
