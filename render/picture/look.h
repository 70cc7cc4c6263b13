// <look>: how a body is drawn.
#pragma once

#include "render/draw/finish.h"
#include "render/picture/colour.h"

#include <optional>

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
  bool edges = true;               // of cells
  // Whether a line is drawn along edges exposed by tearing; none: if anything but cuts tears the body ...
  std::optional<bool> torn_edges = {};
  std::optional<Colour> torn = {}; // ... in this colour; none: orange
  double torn_width = 3.4;         // [pixels] in a picture of height 720
  DrawStyle as = DrawStyle::Surface;
  double apart = 0.4;                 // of exploded cells, in shares of their distance from the middle
  Finish finish = finishes().front(); // one of finishes(), or one of a program's own
  SettingsSource source = {};
};
template <> const Fields<LookSettings>& fields_of();

} // namespace rend
