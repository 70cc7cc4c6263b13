// Outlines: closed curves in the plane, from the path of an SVG file or by name.
//
//   shape="heart"                                  centred on the origin
//   path="M 0 0 h 2 q 1 1 0 2 h -2 z"              commands of SVG 2: M L H V C S Q T A Z, small ones relative
//
// y points up, as everywhere here (in SVG it points down). A subpath that does not end with Z is closed by a
// line. What lies within an odd number of them is inside (the even-odd rule): a ring within a ring is a hole.
// Curves become polygons that deviate from them by 1e-4 of the larger side of the box around all. Arcs: W3C,
// Scalable Vector Graphics 2, appendix B.2.
#pragma once

#include <Eigen/Geometry>

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rend {

using Vec2 = Eigen::Vector2d;
using Contour = std::vector<Vec2>; // a closed polygon: the last point is not the first one again [m]

struct Outline {
  std::vector<Contour> rings; // of three points or more; neighbours differ

  Eigen::AlignedBox2d box() const;
  bool contains(const Vec2& point) const;
  double area() const; // of what is inside, to 1e-3 [m²]
};

// Where a path cannot be read, and why.
struct PathFault : std::invalid_argument {
  PathFault(std::size_t at_, const std::string& what) : std::invalid_argument(what), at(at_) {}
  std::size_t at; // character, from 0
};

Outline outline_of_path(std::string_view path); // PathFault

enum class OutlineName { Path, Heart, Star, Disc, Ring, Drop, Gear };
Outline named_outline(OutlineName name); // CHECK: not Path, which is no name

// So that the larger side of its box has that length [m] and the middle of the box is the origin.
Outline fitted(Outline outline, double size);

} // namespace rend
