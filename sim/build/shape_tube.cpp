#include "sim/build/read_settings.h"
#include "sim/build/shape.h"
#include "sim/mesh/fault.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

const ElementType& tube_type() {
  static const ElementType type{
      "tube", "a rectangular tube along z, of hexahedra, one layer thick", attributes_of<TubeShape>(), {}};
  return type;
}

void check(const TubeShape& shape) {
  check_settings(shape);
  if (shape.around % 4 != 0)
    shape.source.fail(
        "cells",
        fmt::format("the number of cells around the tube must be a multiple of 4, and {} is not", shape.around),
        "take a multiple of 4");
  if (48.0 * shape.around * shape.along >= Dart::none_value)
    shape.source.fail("cells",
                      fmt::format("{} x {} cells are too many for one body", shape.around, shape.along));
  if (2 * shape.wall >= std::min(shape.size.x(), shape.size.y()))
    shape.source.fail(
        "wall",
        fmt::format("a wall of {} leaves no hole in {} x {}", shape.wall, shape.size.x(), shape.size.y()),
        "make it thinner, or take a <bar>");
}

} // namespace

void make_map(Body& body, const TubeShape& shape, const Placement& place) {
  check(shape);
  CellMesh mesh = tube_cells(shape);
  place.apply(mesh.points);
  try {
    body.map = solid_from(mesh);
  } catch (const MeshFault& fault) { // sizes that round to nothing
    shape.source.fail("size", fmt::format("a cell of the tube {}", fault.flaw),
                      "make the sides of the cells more equal, or larger");
  }
}

ShapeType tube_shape() {
  return {tube_type, [](const PresetNode& node) -> ShapeSettings { return read_settings<TubeShape>(node); }};
}

} // namespace rend
