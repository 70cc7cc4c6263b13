#include "sim/build/read_settings.h"
#include "sim/build/shape.h"
#include "sim/mesh/fault.h"

#include <fmt/format.h>

namespace rend {
namespace {

const ElementType& bar_type() {
  static const ElementType type{"bar", "a rectangular bar, a solid", attributes_of<BarShape>(), {}};
  return type;
}

} // namespace

void make_map(Body& body, const BarShape& shape, const Placement& place) {
  check_settings(shape);
  if (static_cast<double>(shape.nx) * shape.ny * shape.nz * bar_darts_per_box >= Dart::none_value)
    shape.source.fail(
        "cells", fmt::format("{} x {} x {} boxes are too many for one body", shape.nx, shape.ny, shape.nz));
  CellMesh mesh = bar_cells(shape);
  place.apply(mesh.points);
  try {
    body.map = solid_from(mesh);
  } catch (const MeshFault& fault) { // sizes that round to nothing
    shape.source.fail("size", fmt::format("a cell of the bar {}", fault.flaw),
                      "make the sides of the cells more equal, or larger");
  }
}

ShapeType bar_shape() {
  return {bar_type, [](const PresetNode& node) -> ShapeSettings { return read_settings<BarShape>(node); }};
}

} // namespace rend
