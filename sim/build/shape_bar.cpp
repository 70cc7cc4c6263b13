#include "sim/build/shape.h"
#include "sim/mesh/bar.h"

#include <fmt/format.h>

namespace rend {
namespace {

const ElementType& bar_type() {
  static const ElementType type{
      "bar",
      "a rectangular bar, a solid",
      {word("pattern", {"hexahedra", "tetrahedra", "prisms", "mixed"},
            "cells: boxes; each box cut in six along its diagonal; each cut in two, parallel to z; slices of "
            "boxes, "
            "of prisms, and of pyramids and tetrahedra by turns along x")
           .otherwise("hexahedra"),
       integers("cells", 3, "how many boxes along x, y and z").at_least(1).at_most(20000).is_required(),
       numbers("size", 3, "m", "lengths along x, y and z").above(0).is_required()},
      {}};
  return type;
}

void build(Body& body, const PresetNode& node, const Placement& place) {
  BarShape shape;
  const std::string& pattern = node.text("pattern");
  shape.pattern = pattern == "hexahedra"    ? BarPattern::Hexahedra
                  : pattern == "tetrahedra" ? BarPattern::Tetrahedra
                  : pattern == "prisms"     ? BarPattern::Prisms
                                            : BarPattern::Mixed;
  const std::vector<double>& cells = node.integers("cells");
  if (cells[0] * cells[1] * cells[2] * bar_darts_per_box >= Dart::none_value)
    node.fail("cells", fmt::format("{} x {} x {} boxes are more than a map of 2^32 darts holds", cells[0],
                                   cells[1], cells[2]));
  shape.nx = static_cast<int>(cells[0]);
  shape.ny = static_cast<int>(cells[1]);
  shape.nz = static_cast<int>(cells[2]);
  shape.size = node.vector("size");
  CellMesh mesh = bar_cells(shape);
  place.apply(mesh.points);
  try {
    body.map = solid_from(mesh);
  } catch (const MeshFault& fault) { // sizes that round to nothing
    node.fail("size", fmt::format("a cell of the bar {}", fault.flaw), "make its sides less unlike, or larger");
  }
}

} // namespace

ShapeType bar_shape() {
  return {bar_type, build};
}

} // namespace rend
