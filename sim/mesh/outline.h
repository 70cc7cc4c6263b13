// Outlines: closed polygons in the plane, from curves (svg_path.h, svg_file.h), a text or a name.
//
//   shape="heart"                                  centred on the origin
//   path="M 0 0 h 2 q 1 1 0 2 h -2 z"              svg_path.h
//   file="key.svg"                                 svg_file.h
//   text="REND"                                    letters of the font that is embedded (sim/font/font.h)
//
// y points up, as everywhere here (in SVG it points down). What lies within an odd number of curves is inside
// (the even-odd rule): a ring within a ring is a hole. Curves become polygons that deviate from them by 1e-4 of
// the larger side of the box around all.
#pragma once

#include "sim/mesh/svg_path.h"

#include <Eigen/Geometry>

#include <string>
#include <string_view>
#include <vector>

namespace rend {

using Contour = std::vector<Vec2>; // a closed polygon: the last point is not the first one again [m]

struct Outline {
  std::vector<Contour> rings; // of three points or more; neighbours differ

  Eigen::AlignedBox2d box() const;
  bool contains(const Vec2& point) const;
  double area() const; // of what is inside, to 1e-3 [m²]
  int regions() const; // that are connected, where no rings cross
};

Outline flattened(const std::vector<Curve>& curves); // it may be empty
Outline outline_of_path(std::string_view path);      // PathFault

enum class OutlineName { Path, Heart, Star, Disc, Ring, Drop, Gear };
Outline named_outline(OutlineName name); // CHECK: not Path, which is no name

// So that the larger side of its box has that length [m] and the middle of the box is the origin.
Outline fitted(Outline outline, double size);

} // namespace rend
