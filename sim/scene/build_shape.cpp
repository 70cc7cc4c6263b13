#include "sim/scene/build_shape.h"

#include "sim/base/math.h"
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

const ElementType& place_type() {
  static const ElementType type{"place",
                                "where the body is at rest: scaled, then rotated, then moved",
                                {number("scale", "", "factor").above(0).otherwise("1"),
                                 numbers("rotate", 3, "degrees", "about x, then y, then z").otherwise("0 0 0"),
                                 numbers("translate", 3, "m", "moved by, last").otherwise("0 0 0")},
                                {}};
  return type;
}

const ElementType& mass_type() {
  static const ElementType type{"mass",
                                "the mass of the body",
                                {number("total", "kg", "of the whole body, spread by area").above(0),
                                 number("density", "kg/m3", "instead; needs the thickness of a sheet").above(0),
                                 number("thickness", "m", "of a sheet").above(0)},
                                {}};
  return type;
}

SheetShape sheet_shape(const Node& node) {
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

Eigen::Matrix3d rotation_about(int axis, double degrees) {
  const double c = cosine_of_degrees(degrees), s = sine_of_degrees(degrees);
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
  r(j, j) = r(k, k) = c;
  r(j, k) = -s;
  r(k, j) = s;
  return r;
}

void place(PolygonMesh& mesh, const Node* node) {
  if (!node) return;
  const Vec3 angles = node->vector("rotate"), shift = node->vector("translate");
  const Eigen::Matrix3d turn = node->number("scale") * rotation_about(2, angles.z()) *
                               rotation_about(1, angles.y()) * rotation_about(0, angles.x());
  for (Vec3& x : mesh.points) x = (turn * x).eval() + shift;
}

void build_mesh(Body& body, const Node& node) {
  const Node& sheet = *node.child("sheet");
  PolygonMesh mesh = sheet_polygons(sheet_shape(sheet));
  place(mesh, node.child("place"));
  body.map = sheet_from(mesh);
  for_each_face(*body.map, [&](Dart d) {
    if (rest_area(*body.map, d) > 0) return;
    const Vec3 x = body.map->rest_of(d);
    throw UserError(
        Exit::BadInput, sheet.place(),
        fmt::format("a cell of the sheet at ({:.4g}, {:.4g}, {:.4g}) has no area", x.x(), x.y(), x.z()),
        "move the corners apart");
  });
}

void build_mass(Body& body, const Node& node) {
  const bool total = node.given("total"), density = node.given("density");
  if (total == density)
    throw UserError(Exit::BadInput, node.place(), "<mass> needs either total or density",
                    "total=\"0.1\", or density=\"300\" with thickness=\"0.001\"");
  if (density && !node.given("thickness"))
    throw UserError(Exit::BadInput, node.place(), "the density of a sheet needs its thickness",
                    "thickness=\"0.001\"");
  if (total && node.given("thickness"))
    node.fail("thickness", "has no use where the total mass is given", "leave it out, or give the density");
  CornerMass embedding;
  if (density) {
    embedding.density = node.number("density") * node.number("thickness");
  } else {
    double area = 0;
    for_each_face(*body.map, [&](Dart d) { area += rest_area(*body.map, d); });
    embedding.density = node.number("total") / area;
  }
  body.mass = &body.map->add(embedding);
}

} // namespace

std::vector<ChildType> shape_types() {
  return {{&sheet_type(), 1, 1}, {&place_type(), 0, 1}, {&mass_type(), 1, 1}};
}

void build_shape(Body& body, const Node& node) {
  build_mesh(body, node);
  build_mass(body, *node.child("mass"));
}

} // namespace rend
