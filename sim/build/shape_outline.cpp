#include "sim/build/read_settings.h"
#include "sim/build/shape.h"
#include "sim/mesh/fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr double most_lost = 0.05; // of the area

const ElementType& outline_type() {
  static const ElementType type{
      "outline",
      "what lies within an outline: a heart, a star, an SVG path; a sheet, or a solid of some depth",
      attributes_of<OutlineShape>(),
      {}};
  return type;
}

bool turns_left(const PolygonMesh& mesh, std::size_t triangle) {
  const std::uint32_t* c = mesh.corners.data() + 3 * triangle;
  const Vec3 a = mesh.points[c[0]];
  return (mesh.points[c[1]] - a).cross(mesh.points[c[2]] - a).z() > 0;
}

Outline outline_of(const OutlineShape& shape) {
  const SettingsSource& source = shape.source;
  if (shape.name != OutlineName::Path) {
    if (!shape.path.empty())
      source.fail("path", "the outline has both a shape and a path", "leave out one of them");
    return fitted(named_outline(shape.name), shape.size.value_or(1));
  }
  if (shape.path.empty())
    source.fail("", "<outline> needs a shape or a path", "shape=\"heart\", or path=\"M 0 0 L 1 0 L 0.5 1 Z\"");
  try {
    Outline outline = outline_of_path(shape.path);
    return shape.size ? fitted(std::move(outline), *shape.size) : outline;
  } catch (const PathFault& fault) {
    source.fail("path", fmt::format("character {}: {}", fault.at + 1, fault.what()),
                "paths are those of SVG, as in path=\"M 0 0 L 1 0 L 0.5 1 Z\"");
  }
}

int layers_of(const OutlineShape& shape) {
  return shape.depth ? std::max(1, static_cast<int>(std::lround(std::min(*shape.depth / shape.cell, 1e6)))) : 0;
}

// Before memory is asked for: the lattice covers the box.
void check_cells(const OutlineShape& shape, const Outline& outline) {
  const Eigen::Vector2d box = outline.box().sizes() / shape.cell;
  const double triangles = 2.4 * (box.x() + 4) * (box.y() + 4),
               darts = shape.depth ? 72.0 * layers_of(shape) : 6;
  if (!(triangles * darts < Dart::none_value))
    shape.source.fail("cell", fmt::format("cells of {:g} m are too many for one body", shape.cell),
                      "lengths are in metres");
}

PolygonMesh triangles_of(const OutlineShape& shape, const Outline& outline) {
  PolygonMesh mesh = triangles_within(outline, shape.cell);
  for (std::size_t t = 0; t < mesh.polygons(); ++t)
    if (!turns_left(mesh, t))
      shape.source.fail("cell", "a cell of the outline is turned around", "take smaller cells");
  const double asked = outline.area(), got = area_of(mesh);
  if (!(asked > 0)) shape.source.fail("path", "the outline encloses no area", "its points lie on a line");
  if (!(std::abs(got - asked) <= most_lost * asked))
    shape.source.fail(
        "cell",
        fmt::format("cells of {:g} m are too large for the outline: its area is {:.3g} m2, theirs {:.3g}",
                    shape.cell, asked, got),
        "take smaller cells: two or more across its thinnest part");
  return mesh;
}

} // namespace

void make_map(Body& body, const OutlineShape& shape, const Placement& place) {
  check_settings(shape);
  const Outline outline = outline_of(shape);
  check_cells(shape, outline);
  PolygonMesh triangles = triangles_of(shape, outline);
  try {
    if (!shape.depth) {
      place.apply(triangles.points);
      body.map = sheet_from(triangles);
      return;
    }
    CellMesh cells = extruded(triangles, *shape.depth, layers_of(shape));
    place.apply(cells.points);
    body.map = solid_from(cells);
  } catch (const MeshFault& fault) {
    shape.source.fail("cell", fmt::format("a cell of the outline {}", fault.flaw), "take smaller cells");
  }
}

ShapeType outline_shape() {
  return {outline_type,
          [](const PresetNode& node) -> ShapeSettings { return read_settings<OutlineShape>(node); }};
}

} // namespace rend
