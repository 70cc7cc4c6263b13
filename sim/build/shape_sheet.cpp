#include "sim/build/read_settings.h"
#include "sim/build/shape.h"

#include <fmt/format.h>

namespace rend {
namespace {

const ElementType& sheet_type() {
  static const ElementType type{"sheet", "a rectangular sheet, or a band", attributes_of<SheetShape>(), {}};
  return type;
}

void check(const SheetShape& shape) {
  check_settings(shape);
  const SettingsSource& source = shape.source;
  if (24.0 * shape.nx * shape.ny >= Dart::none_value) // the most darts that a cell can have
    source.fail("cells", fmt::format("{} x {} cells are too many for one body", shape.nx, shape.ny));
  if (shape.size.has_value() == shape.corners.has_value())
    source.fail("",
                shape.size ? "<sheet> has both a size and corners" : "<sheet> has neither a size nor corners",
                "give one of them: size=\"1 1\"");
  const bool band = shape.closure != SheetClosure::None;
  if (band && shape.corners)
    source.fail("corners", "a band (close) cannot be given by corners", "give its size: around and across");
  if (band && shape.nx < 3) source.fail("cells", "a band needs at least 3 cells around");
}

} // namespace

void make_map(Body& body, const SheetShape& shape, const Placement& place) {
  check(shape);
  PolygonMesh mesh = sheet_polygons(shape);
  place.apply(mesh.points);
  body.map = sheet_from(mesh);
  for_each_face(*body.map, [&](Dart d) {
    if (rest_area(*body.map, d) > 0) return;
    const Vec3 x = body.map->rest_of(d);
    shape.source.fail(
        "", fmt::format("a cell of the sheet at ({:.4g}, {:.4g}, {:.4g}) has no area", x.x(), x.y(), x.z()),
        "move the corners apart");
  });
}

ShapeType sheet_shape() {
  return {sheet_type, [](const PresetNode& node) -> ShapeSettings { return read_settings<SheetShape>(node); }};
}

} // namespace rend
