// A frame: all that is needed to draw one picture, and nothing of how it came about.
//
// Bodies come as corners, three a triangle, not indexed: every corner has its own normal, so that a Möbius band
// (no consistent sides), a crease and a face laid bare by fracture need no special case; and the line along
// each side of a triangle is a property of the corner opposite to it, so that a quad shows as a quad.
#pragma once

#include "render/draw/finish.h"
#include "render/draw/hud_content.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace rend {

// The line drawn along a side of a triangle.
enum class Line : std::uint8_t {
  None = 0,   // the diagonal of a quad
  Cell = 1,   // an edge between two cells
  Border = 2, // an edge that was a border from the start
  Torn = 3,   // an edge laid bare by tearing
  Crease = 4, // a sharp edge of a solid
};

inline std::array<float, 3> as_floats(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

// One corner of a drawn triangle: 32 bytes, uploaded as it is.
struct Corner {
  std::array<float, 3> position;      // [m]
  std::array<float, 3> normal;        // unit, or 0 for a flat triangle; the three of a triangle agree in sign
  std::array<std::uint8_t, 4> colour; // sRGB, alpha = 255
  std::array<std::uint8_t, 4> line; // [k]: Line along the side opposite to corner k, alike in all three; [3]: 0
};
static_assert(sizeof(Corner) == 32);

struct FrameBody {
  std::vector<Corner> corners; // 3 a triangle
  bool edges = true;           // draw lines of cells and creases (torn and border lines are drawn all the same)
  bool two_sided = true; // a sheet; false: a solid, whose triangles run counter-clockwise seen from outside and
                         // are drawn from there alone
  bool sides = true;     // a sheet's far side is a shade darker; false: there is but one side (a Möbius band)
  std::optional<std::array<std::uint8_t, 3>> back; // sRGB, of a sheet's far side; none: as the near side
  Finish finish = finishes().front();
  bool filled = true; // false: only the lines are there, and one sees through (a wire frame)
};

struct FrameCamera {
  Eigen::Vector3d eye{3, -3, 2}, target{0, 0, 0}, up{0, 0, 1}; // [m]
  double fov = 35;                                             // vertical angle [degrees]
};

struct FrameFloor {
  double z = 0; // [m]
};

struct Frame {
  double time = 0; // [s]
  int number = 0;  // from 0
  std::vector<FrameBody> bodies;
  std::vector<FrameBody> obstacles;
  std::optional<FrameFloor> floor;
  FrameCamera camera;
  std::optional<Eigen::Vector3d>
      light; // towards the key light, any length; none: over the camera's left shoulder
  std::array<float, 3> background{0.93f, 0.94f, 0.96f}; // sRGB; a soft gradient around it
  bool transparent = false; // nothing is behind the bodies, not even the floor: the picture has an alpha
  bool occlusion = false;   // what stands near a place keeps light from it: ambient occlusion
  HudContent hud;           // written over it all; empty: nothing is
};

} // namespace rend
