#include "sim/build/named_file.h"
#include "sim/build/read_settings.h"
#include "sim/build/shape.h"
#include "sim/mesh/fault.h"
#include "sim/mesh/svg_file.h"
#include "sim/mesh/text_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr double most_lost = 0.05; // of the area

const ElementType& outline_type() {
  static const ElementType type{
      "outline",
      "what lies within an outline: a heart, a star, letters, a drawing; a sheet, or a solid of some depth",
      attributes_of<OutlineShape>(),
      {}};
  return type;
}

bool turns_left(const PolygonMesh& mesh, std::size_t triangle) {
  const std::uint32_t* c = mesh.corners.data() + 3 * triangle;
  const Vec3 a = mesh.points[c[0]];
  return (mesh.points[c[1]] - a).cross(mesh.points[c[2]] - a).z() > 0;
}

// An outline, and how many connected parts its mesh has to have; 0: any number.
struct AskedOutline {
  Outline outline;
  int parts = 0;
};

Outline outline_of_data(const OutlineShape& shape) {
  try {
    return outline_of_path(shape.path);
  } catch (const PathFault& fault) {
    shape.source.fail("path", fmt::format("character {}: {}", fault.at + 1, fault.what()),
                      "paths are those of SVG, as in path=\"M 0 0 L 1 0 L 0.5 1 Z\"");
  }
}

AskedOutline outline_of_letters(const OutlineShape& shape) {
  try {
    TextOutline text = outline_of_text(shape.text);
    return {fitted(std::move(text.outline), shape.size.value_or(1)), text.letters};
  } catch (const TextFault& fault) {
    shape.source.fail("text", fault.what(), fault.hint);
  }
}

// Of settings that name one of shape, path, file and text.
AskedOutline outline_of(const OutlineShape& shape) {
  if (!shape.text.empty()) return outline_of_letters(shape);
  if (!shape.file.empty())
    return {fitted(outline_of_svg(open_file_of(shape.source, shape.file)), shape.size.value_or(1)), 1};
  if (shape.name != OutlineName::Path) return {fitted(named_outline(shape.name), shape.size.value_or(1))};
  Outline outline = outline_of_data(shape);
  return {shape.size ? fitted(std::move(outline), *shape.size) : std::move(outline)};
}

void check_given(const OutlineShape& shape) {
  std::vector<const char*> given;
  if (shape.name != OutlineName::Path) given.push_back("shape");
  if (!shape.path.empty()) given.push_back("path");
  if (!shape.file.empty()) given.push_back("file");
  if (!shape.text.empty()) given.push_back("text");
  if (given.empty())
    shape.source.fail("", "<outline> needs a shape, a path, a file or a text",
                      "shape=\"heart\", path=\"M 0 0 L 1 0 L 0.5 1 Z\", file=\"key.svg\", or text=\"A\"");
  if (given.size() > 1)
    shape.source.fail(given[1], fmt::format("the outline has both a {} and a {}", given[0], given[1]),
                      "leave out one of them");
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

// Letters that have grown together, or a drawing that is not connected or lost a thin neck.
void check_parts(const OutlineShape& shape, const PolygonMesh& mesh, int asked) {
  const int parts = parts_of(mesh);
  if (asked == 0 || parts == asked) return;
  if (!shape.text.empty())
    shape.source.fail("cell",
                      fmt::format("with cells of {:g} m, {} {} {} part{}", shape.cell, asked,
                                  asked == 1 ? "letter makes" : "letters make", parts, parts == 1 ? "" : "s"),
                      "take smaller cells: two or more across the thinnest part, and between letters");
  shape.source.fail(
      "file", fmt::format("the drawing falls into {} parts that are not connected", parts),
      "one connected region makes a body: join its shapes, or take smaller cells where it is thin");
}

PolygonMesh triangles_of(const OutlineShape& shape, const AskedOutline& given) {
  const Outline& outline = given.outline;
  PolygonMesh mesh = triangles_within(outline, shape.cell);
  for (std::size_t t = 0; t < mesh.polygons(); ++t)
    if (!turns_left(mesh, t))
      shape.source.fail("cell", "a cell of the outline is turned around", "take smaller cells");
  const double asked = outline.area(), got = area_of(mesh);
  if (!(asked > 0))
    shape.source.fail(shape.file.empty() ? "path" : "file", "the outline encloses no area",
                      "its points lie on a line, or its parts cover each other: what lies in an even number of "
                      "them is outside");
  if (!(std::abs(got - asked) <= most_lost * asked))
    shape.source.fail(
        "cell",
        fmt::format("cells of {:g} m are too large for the outline: its area is {:.3g} m2, theirs {:.3g}",
                    shape.cell, asked, got),
        "take smaller cells: two or more across its thinnest part");
  check_parts(shape, mesh, given.parts);
  return mesh;
}

} // namespace

void make_map(Body& body, const OutlineShape& shape, const Placement& place) {
  check_settings(shape);
  check_given(shape);
  const AskedOutline given = outline_of(shape);
  check_cells(shape, given.outline);
  PolygonMesh triangles = triangles_of(shape, given);
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
