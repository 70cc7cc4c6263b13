// <look>: how a body is drawn.
#pragma once

#include "render/draw/finish.h"
#include "render/draw/frame.h"
#include "render/picture/colour.h"
#include "sim/build/picture_frame.h"

#include <filesystem>
#include <optional>
#include <string>

namespace rend {

// What the colour of a body shows.
enum class ColourBy { Plain, Strain, Stress, Force, Fragment };
// What is drawn of it.
enum class DrawStyle { Surface, Wires, Exploded, Darts };

struct LookSettings {
  Colour colour{0x2a, 0x7f, 0x8e};
  std::optional<Colour> back = {}; // of a sheet's far side; none: the colour, a shade darker
  Colour inside{0xe8, 0xb2, 0x7a}; // of the faces of a solid that fracture lays bare
  ColourBy by = ColourBy::Plain;   // the largest principal strain or stress [Pa], or force [N]
  std::optional<double> most = {}; // the quantity at the end of the scale; none: the most seen so far
  std::optional<bool> edges = {};  // whether those of cells are drawn; none: draws_edges()
  // Whether a line is drawn along torn edges; none: where edges are drawn, unless only cuts tear the body ...
  std::optional<bool> torn_edges = {};
  std::optional<Colour> torn = {}; // ... in this colour; none: orange
  double torn_width = 3.4;         // [pixels] in a picture of height 720
  DrawStyle as = DrawStyle::Surface;
  double apart = 0.4;                       // of exploded cells, in shares of their distance from the middle
  Finish finish = finishes().front();       // one of finishes(), or one of a program's own
  std::optional<Finish> finish_inside = {}; // of the faces that fracture lays bare; none: `finish`
  // Files of pictures, in place of `colour`, `back` and `inside`; empty: none. Where they lie: texture_map.h.
  std::string texture = {}, texture_back = {}, texture_inside = {};
  std::string roughness = {}, roughness_inside = {}; // likewise, of how rough the surface is (finish.h)
  std::optional<Wrap> wrap = {};     // none: clamped where a picture is spread over a sheet once, else repeated
  std::array<double, 2> scale{1, 1}; // of pictures: how much wider and higher than by default
  double rotate = 0;                 // of pictures, about their middle, anticlockwise from the front [degrees]
  TextureFrame frame = {};           // from the body's shape and place
  std::filesystem::path folder = {}; // to which files of pictures are relative
  int smooth = 1;                    // parts into which each side is divided: curved_triangles.h
  // Of a sheet as it is drawn [m]: sheet_rim.h; none: that of its mass, where it can be seen
  std::optional<double> thickness = {};
  std::optional<double> mass_thickness = {}; // [m], of <mass>; none: it says none
  SettingsSource source = {};
};
template <> const Fields<LookSettings>& fields_of();

// Lines of cells: by default where there are no surfaces that show a shape without them.
inline bool draws_edges(const LookSettings& look) {
  return look.edges.value_or(look.as == DrawStyle::Wires || look.as == DrawStyle::Exploded);
}

} // namespace rend
