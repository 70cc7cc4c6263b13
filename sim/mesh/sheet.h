// Rectangular sheets: quads, triangles, or a mixture, open or closed to a band.
//
//   quads      nx × ny quads, row after row from y = 0
//   triangles  each quad cut along the diagonal from its first corner
//   crossed    each quad cut into four triangles around its centre (the thesis's triangulation, fig. 3.22)
//   mixed      every second quad, as on a chessboard, is crossed
//
// close = loop joins the sides x = 0 and x = lx; twist joins them reversed, which makes a Möbius band. The
// points of a band are those of a cylinder (a half-turned strip) around the y axis, of circumference lx.
#pragma once

#include "sim/base/settings.h"
#include "sim/mesh/polygons.h"

#include <array>
#include <optional>

namespace rend {

enum class SheetPattern { Quads, Triangles, Crossed, Mixed };
enum class SheetClosure { None, Loop, Twist };

// Either size or corners; a band has a size.
struct SheetShape {
  SheetPattern pattern = SheetPattern::Quads;
  int nx = 1, ny = 1;                              // cells
  std::optional<std::array<double, 2>> size = {};  // lx, ly [m]; of a band: around and across
  std::optional<std::array<Vec3, 4>> corners = {}; // [m]: (0,0), (lx,0), (lx,ly), (0,ly); points are bilinear
  SheetClosure closure = SheetClosure::None;
  SettingsSource source = {};
};
template <> const Fields<SheetShape>& fields_of();

// CHECK: it has a size or corners; a band a size.
PolygonMesh sheet_polygons(const SheetShape& shape);

} // namespace rend
