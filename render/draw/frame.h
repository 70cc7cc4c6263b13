// A frame: everything that is needed to draw one picture, independent of the simulation.
//
// Bodies are triangle soups: three corners per triangle, not indexed. Every corner has its own normal, so that
// a Möbius band (not orientable), a crease and a face exposed by fracture need no special case; and the line
// along each side of a triangle is an attribute of the opposite corner, so that a quad shows as a quad.
#pragma once

#include "render/draw/finish.h"
#include "render/draw/hud_content.h"
#include "render/draw/texture.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace rend {

// The line drawn along a side of a triangle.
enum class Line : std::uint8_t {
  None = 0,   // the diagonal of a quad
  Cell = 1,   // an edge between two cells
  Border = 2, // an edge that was a border from the start
  Torn = 3,   // an edge exposed by tearing
  Crease = 4, // a sharp edge of a solid
};

// Triangles that reach farther from the origin than this are not drawn (packing.h): a hundred times as far as a
// preset can put anything, so that lengths within a picture are numbers of single precision.
constexpr float farthest_drawn = 1e32f; // [m]

// What is farther is put where it is not drawn either, but is finite, and so is any mean of two such places.
inline std::array<float, 3> as_floats(const Eigen::Vector3d& v) {
  const auto within = [](double x) { return static_cast<float>(std::clamp(x, -1e36, 1e36)); };
  return {within(v.x()), within(v.y()), within(v.z())};
}

// One corner of a drawn triangle: 32 bytes, uploaded as it is.
struct Corner {
  std::array<float, 3> position; // [m]
  // unit, or 0 for a flat triangle; the normals of a triangle lie on the same side of it
  std::array<float, 3> normal;
  std::array<std::uint8_t, 4> colour; // sRGB, alpha = 255
  // [k]: Line along the side opposite to corner k, the same in all three corners; [3]: 0
  std::array<std::uint8_t, 4> line;
};
static_assert(sizeof(Corner) == 32);

// Lines along edges exposed by tearing.
struct TornLine {
  std::array<float, 3> colour{1.0f, 0.46f, 0.09f}; // linear: an orange
  float width = 3.4f;                              // [pixels] in a picture of height 720; 0: no line
  bool operator==(const TornLine&) const = default;
};

// A place in a picture: u to the right, v up; the picture covers 0 to 1.
using TexturePoint = std::array<float, 2>;

// How a picture goes on beyond 0 and 1.
enum class Wrap : std::uint8_t { Repeat, Clamp, Mirror };

// The pictures on a body. Those of a sheet's two sides lie back to back, so that both read from left to right.
struct FrameTexture {
  std::shared_ptr<const Texture> front, back; // null: plain; back: of a sheet
  Wrap wrap = Wrap::Repeat;
  float back_height = 1; // v - 1/2 in `back`, over that in `front`: pictures of other proportions are as wide
  // How rough the surface is, 0 to 1, on both sides of a sheet (finish.h); null: as its finish
  std::shared_ptr<const Texture> roughness = {};

  bool any() const { return front || back || roughness; }
};

// Which sides of a sheet are drawn: the front is that of the normals.
enum class SheetSides : std::uint8_t { Both, Front, Back };

struct FrameBody {
  std::vector<Corner> corners; // three per triangle
  FrameTexture texture;
  std::vector<TexturePoint> texture_points; // one per corner; empty without a texture
  bool edges = true; // draw lines of cells and creases (torn and border lines are drawn in any case)
  TornLine torn;
  // a sheet; false: a solid, whose triangles are counter-clockwise seen from outside, with back faces culled
  bool two_sided = true;
  SheetSides sides = SheetSides::Both; // of a sheet
  // the back of a sheet is drawn a shade darker; false: front and back alike (a Möbius band)
  bool shades_back = true;
  std::optional<std::array<std::uint8_t, 3>> back; // sRGB, of a sheet's back; none: as the front
  Finish finish = finishes().front();
  bool filled = true; // false: lines only (a wire frame)
};

struct FrameCamera {
  Eigen::Vector3d eye{3, -3, 2}, target{0, 0, 0}, up{0, 0, 1}; // [m]
  double fov = 35;                                             // vertical angle [degrees]
};

struct FrameFloor {
  double z = 0; // [m]
};

// Bodies and obstacles as they are in one state of the simulation.
struct FrameState {
  std::vector<FrameBody> bodies, obstacles;
  // Grows with each change of what there is to draw: between two states of one shape, only positions, normals
  // and colours differ, corner by corner.
  long shape = 0;
};

// A moment of the time for which the shutter is open.
struct FrameMoment {
  std::size_t before = 0, after = 0; // of Frame::states
  double share = 1;                  // of the way from the one to the other
  FrameCamera camera = {};
  int weight = 1; // in the mean
};

struct Frame {
  double time = 0; // [s]
  int number = 0;  // from 0
  std::vector<FrameBody> bodies;
  std::vector<FrameBody> obstacles;
  std::optional<FrameFloor> floor;
  FrameCamera camera;
  std::optional<Eigen::Vector3d>
      light; // towards the key light, any length; none: from over the camera's left shoulder
  std::array<float, 3> background{0.93f, 0.94f, 0.96f}; // sRGB; a soft gradient around it
  bool transparent = false;  // no floor and no backdrop: the picture has an alpha channel
  bool floor_shadow = false; // of a transparent one: the floor is there, but only its shadows are seen
  bool occlusion = false;    // draw with ambient occlusion

  bool has_floor() const {
    return floor && (!transparent || floor_shadow);
  }               // the floor, or only its shadows, are drawn
  HudContent hud; // drawn over the picture; empty: nothing
  // Motion blur: the picture is the mean of those at these moments, in linear light. They take the place of
  // bodies, obstacles and camera. Empty: a plain picture.
  std::vector<FrameMoment> moments;
  std::vector<FrameState> states;
};

} // namespace rend
