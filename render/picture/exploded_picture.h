// Exploded view: every face of a sheet, every volume of a solid is drawn separately, moved away from the body's
// centre m in proportion to the distance of the cell's centre c:
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
  bool inner; // its face was between two cells at the start
};

// Appends the triangles to `out`; those of a solid are counter-clockwise seen from outside of each volume,
// unless that is inverted.
void draw_exploded(const Body& body, double apart, const std::function<Colour(const CellCorner&)>& colour,
                   FrameBody& out);

} // namespace rend
