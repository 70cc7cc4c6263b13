// A body whose cells are drawn apart: every face of a sheet, every volume of a solid, whole and by itself,
// moved away from the body's middle by a share of its distance from there:
//
//   x' = x + apart (c − m)
#pragma once

#include "render/draw/frame.h"
#include "render/picture/colour.h"
#include "sim/body/body.h"

#include <functional>

namespace rend {

// A corner of a cell's face.
struct CellCorner {
  Dart dart;
  Slot vertex;
  bool inner; // its face lay between two cells at the start
};

// Appends the triangles to `out`; a solid's run counter-clockwise seen from outside of each volume that is not
// inverted.
void draw_exploded(const Body& body, double apart, const std::function<Colour(const CellCorner&)>& colour,
                   FrameBody& out);

} // namespace rend
