#include "sim/build/shape.h"
#include "sim/mesh/tube.h"

#include <fmt/format.h>

namespace rend {
namespace {

const ElementType& tube_type() {
  static const ElementType type{
      "tube",
      "a rectangular tube along z, of hexahedra, one layer thick",
      {integers("cells", 2, "how many around, a multiple of 4, and along")
           .at_least(1)
           .at_most(20000)
           .is_required(),
       numbers("size", 3, "m", "outer lengths along x, y and z").above(0).is_required(),
       number("wall", "m", "how thick it is: less than half of the outer lengths along x and y")
           .above(0)
           .is_required()},
      {}};
  return type;
}

void build(Body& body, const PresetNode& node, const Placement& place) {
  TubeShape shape;
  shape.around = static_cast<int>(node.integers("cells")[0]);
  shape.along = static_cast<int>(node.integers("cells")[1]);
  shape.size = node.vector("size");
  shape.wall = node.number("wall");
  if (shape.around % 4 != 0)
    node.fail("cells",
              fmt::format("{} cells around do not put a border at each corner of the tube", shape.around),
              "take a multiple of 4");
  if (48.0 * shape.around * shape.along >= Dart::none_value)
    node.fail("cells",
              fmt::format("{} x {} cells are more than a map of 2^32 darts holds", shape.around, shape.along));
  if (2 * shape.wall >= std::min(shape.size.x(), shape.size.y()))
    node.fail("wall",
              fmt::format("a wall of {} leaves no hole in {} x {}", shape.wall, shape.size.x(), shape.size.y()),
              "make it thinner, or take a <bar>");
  CellMesh mesh = tube_cells(shape);
  place.apply(mesh.points);
  try {
    body.map = solid_from(mesh);
  } catch (const MeshFault& fault) { // sizes that round to nothing
    node.fail("size", fmt::format("a cell of the tube {}", fault.flaw),
              "make its sides less unlike, or larger");
  }
}

} // namespace

ShapeType tube_shape() {
  return {tube_type, build};
}

} // namespace rend
