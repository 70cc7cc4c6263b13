#include "sim/build/shape.h"
#include "sim/mesh/sheet.h"

#include <fmt/format.h>

namespace rend {
namespace {

const ElementType& sheet_type() {
  static const ElementType type{
      "sheet",
      "a rectangular sheet, or a band",
      {word("pattern", {"quads", "triangles", "crossed", "mixed"},
            "cells: quads; each quad cut along a diagonal; cut in four around its centre; every second one so")
           .otherwise("quads"),
       integers("cells", 2, "how many along x and y").at_least(1).at_most(20000).is_required(),
       numbers("size", 2, "m", "lengths along x and y (of a band: around and across)").above(0),
       numbers("corners", 12, "m", "the four corners instead, around the sheet; points are bilinear"),
       word("close", {"none", "loop", "twist"}, "join the ends x = 0 and x = lx: a band, a Moebius band")
           .otherwise("none")},
      {}};
  return type;
}

SheetShape sheet_of(const PresetNode& node) {
  SheetShape shape;
  const std::string& pattern = node.text("pattern");
  shape.pattern = pattern == "quads"       ? SheetPattern::Quads
                  : pattern == "triangles" ? SheetPattern::Triangles
                  : pattern == "crossed"   ? SheetPattern::Crossed
                                           : SheetPattern::Mixed;
  const std::string& close = node.text("close");
  shape.closure = close == "none"   ? SheetClosure::None
                  : close == "loop" ? SheetClosure::Loop
                                    : SheetClosure::Twist;
  shape.nx = static_cast<int>(node.integers("cells")[0]);
  shape.ny = static_cast<int>(node.integers("cells")[1]);
  if (24.0 * shape.nx * shape.ny >= Dart::none_value) // the most darts that a cell can have
    node.fail("cells",
              fmt::format("{} x {} cells are more than a map of 2^32 darts holds", shape.nx, shape.ny));
  const bool size = node.given("size"), corners = node.given("corners");
  if (size == corners)
    throw UserError(Exit::BadInput, node.place(),
                    size ? "<sheet> has both a size and corners" : "<sheet> has neither a size nor corners",
                    "give one of them: size=\"1 1\"");
  if (shape.closure != SheetClosure::None && corners)
    node.fail("corners", "a band has no corners", "give its size: around and across");
  if (shape.closure != SheetClosure::None && shape.nx < 3)
    node.fail("cells", "a band needs at least 3 cells around");
  if (size) {
    shape.lx = node.numbers("size")[0];
    shape.ly = node.numbers("size")[1];
    shape.corners = rectangle(shape.lx, shape.ly);
  } else {
    for (std::size_t c = 0; c < 4; ++c) {
      const double* x = node.numbers("corners").data() + 3 * c;
      shape.corners[c] = Vec3(x[0], x[1], x[2]);
    }
  }
  return shape;
}

void build(Body& body, const PresetNode& node, const Placement& place) {
  PolygonMesh mesh = sheet_polygons(sheet_of(node));
  place.apply(mesh.points);
  body.map = sheet_from(mesh);
  for_each_face(*body.map, [&](Dart d) {
    if (rest_area(*body.map, d) > 0) return;
    const Vec3 x = body.map->rest_of(d);
    throw UserError(
        Exit::BadInput, node.place(),
        fmt::format("a cell of the sheet at ({:.4g}, {:.4g}, {:.4g}) has no area", x.x(), x.y(), x.z()),
        "move the corners apart");
  });
}

} // namespace

ShapeType sheet_shape() {
  return {sheet_type, build};
}

} // namespace rend
