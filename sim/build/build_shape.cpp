#include "sim/build/build_shape.h"

#include "sim/base/wording.h"
#include "sim/build/shape.h"

#include <fmt/format.h>

#include <cmath>

namespace rend {
namespace {

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
                                {number("total", "kg", "of the whole body, spread by area or volume").above(0),
                                 number("density", "kg/m3", "instead; needs the thickness of a sheet").above(0),
                                 number("thickness", "m", "of a sheet").above(0)},
                                {}};
  return type;
}

// Energies and volumes are products of a few lengths: beyond this they need not be numbers any more.
constexpr double farthest = 1e30; // [m]

void check_reach(const Body& body, const PresetNode& shape) {
  for (const Record& x : body.map->rest().values())
    for (double component : {x.x, x.y, x.z})
      if (!(std::abs(component) <= farthest))
        throw UserError(
            Exit::BadInput, shape.place(),
            fmt::format("a vertex lies {:g} m from the origin, and at most {:g} m are reckoned with",
                        std::abs(component), farthest),
            "scale and translate of <place>, and the sizes of the shape, are in metres");
}

void build_map(Body& body, const PresetNode& node) {
  std::vector<std::string> names;
  const PresetNode* chosen = nullptr;
  const ShapeType* how = nullptr;
  for (const ShapeType& shape : all_shapes()) {
    names.push_back(shape.type().name);
    const PresetNode* here = node.child(names.back());
    if (!here) continue;
    if (chosen)
      throw UserError(Exit::BadInput, here->place(),
                      fmt::format("the body has both a <{}> and a <{}>", chosen->name(), here->name()),
                      "a body has one shape; write two bodies");
    chosen = here;
    how = &shape;
  }
  if (!chosen)
    throw UserError(Exit::BadInput, node.place(), "<body> needs a shape", "one of: " + listed(names));
  how->build(body, *chosen, Placement(node.child("place")));
  check_reach(body, *chosen);
}

// Of all elements: the area of a sheet [m²], the volume of a solid [m³].
double extent(const EmbeddedMap& map) {
  double sum = 0;
  if (map.dimension() == 2) {
    for_each_face(map, [&](Dart d) { sum += rest_area(map, d); });
    return sum;
  }
  const CellIndex volumes(map.map(), Volume);
  for (Slot v = 0; v < volumes.slots(); ++v) sum += rest_volume(map, volumes.first_dart(v));
  return sum;
}

void build_mass(Body& body, const PresetNode& node) {
  const bool sheet = body.map->dimension() == 2;
  const bool total = node.given("total"), density = node.given("density");
  if (total == density)
    throw UserError(Exit::BadInput, node.place(),
                    total ? "<mass> has both total and density" : "<mass> needs total or density",
                    sheet ? "total=\"0.1\", or density=\"300\" with thickness=\"0.001\""
                          : "total=\"0.1\", or density=\"1000\"");
  if (!sheet && node.given("thickness"))
    node.fail("thickness", "has no use in a solid, whose volume is known", "leave it out");
  if (sheet && density && !node.given("thickness"))
    throw UserError(Exit::BadInput, node.place(), "the density of a sheet needs its thickness",
                    "thickness=\"0.001\"");
  if (total && node.given("thickness"))
    node.fail("thickness", "has no use where the total mass is given", "leave it out, or give the density");
  CornerMass mass;
  if (total)
    mass.density = node.number("total") / extent(*body.map);
  else
    mass.density = sheet ? node.number("density") * node.number("thickness") : node.number("density");
  body.mass = &body.map->add(mass.on(*body.map));
}

} // namespace

std::vector<ChildType> shape_types() {
  std::vector<ChildType> types;
  for (const ShapeType& shape : all_shapes()) types.push_back({&shape.type(), 0, 1});
  types.push_back({&place_type(), 0, 1});
  types.push_back({&mass_type(), 1, 1});
  return types;
}

void build_shape(Body& body, const PresetNode& node) {
  build_map(body, node);
  build_mass(body, *node.child("mass"));
}

} // namespace rend
