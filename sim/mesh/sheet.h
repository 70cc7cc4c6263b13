// Rectangular sheets: quads, triangles, or a mixture, open or closed to a band.
//
//   quads      nx × ny quads, row after row from y = 0
//   triangles  each quad cut along the diagonal from its first corner
//   crossed    each quad cut into four triangles around its centre (the thesis's triangulation, fig. 3.22)
//   mixed      every second quad, as on a chessboard, crossed
//
// close = loop joins the sides x = 0 and x = lx; twist joins them upside down, which makes a Möbius band. The
// points of a band are those of a cylinder (a half-turned strip) around the y axis, of circumference lx.
#pragma once

#include "sim/mesh/polygons.h"

namespace rend {

enum class SheetPattern { Quads, Triangles, Crossed, Mixed };
enum class SheetClosure { None, Loop, Twist };

struct SheetShape {
  SheetPattern pattern = SheetPattern::Quads;
  int nx = 1, ny = 1;            // cells
  std::array<Vec3, 4> corners{}; // of the sheet: (0,0), (lx,0), (lx,ly), (0,ly); points are bilinear
  SheetClosure closure = SheetClosure::None;
  double lx = 1, ly = 1; // [m], of a band
};

// corners of a rectangle in the xy plane
std::array<Vec3, 4> rectangle(double lx, double ly);

PolygonMesh sheet_polygons(const SheetShape& shape);

} // namespace rend
