// Obstacles of any shape: a surface of triangles that stands still or moves as one rigid body
// (obstacle_motion.h).
//
// Closed surfaces have an inside, and things are kept out of it. An open one is a sheet: things stay on the
// side of it on which they are.
//
// For contact its vertices are vertices like others whose motion is prescribed (sim/contact/contact_body.h),
// so vertices, edges and faces of bodies meet its faces, edges and vertices as those of another body.
#pragma once

#include "sim/outside/obstacle_motion.h"

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rend {

struct MeshObstacleSettings {
  std::string file = {};                                 // what it is read from (sim/build/read_obstacle.h)
  ObstacleMotion motion = {};                            // its middle: that of its bounding box
  std::optional<double> friction = {}, restitution = {}; // coefficients; none: those of the body
  std::string name = {};                                 // empty: none
  SettingsSource source = {};
};
template <> const Fields<MeshObstacleSettings>& fields_of();

// Triangles and where the preset puts them.
struct ObstacleSurface {
  std::vector<Vec3> points;                            // [m], each in a triangle
  std::vector<std::array<std::uint32_t, 3>> triangles; // indices of points; counter-clockwise from outside
  bool closed = false;
};

struct MeshObstacle : MeshObstacleSettings {
  // UserError, with its place: there are no triangles, their points do not fit, or what moves it does not fit
  // together.
  MeshObstacle(const MeshObstacleSettings& settings, ObstacleSurface of);

  ObstacleSurface surface;
  Eigen::AlignedBox3d bounds; // [m], of its points as the preset puts them

  Vec3 middle() const { return bounds.center(); }
  bool moves() const { return motion.moves(); }
  Pose pose(double time) const { return motion.at(middle(), time); } // [s]
  double volume() const;                                             // [m³], within a closed one
  std::size_t bytes() const;

  std::vector<std::string> notes; // messages for the author of the preset
};

} // namespace rend
