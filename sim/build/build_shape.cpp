#include "sim/build/build_shape.h"

#include "sim/base/reach.h"
#include "sim/build/body_at_rest.h"
#include "sim/build/construction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

void check_reach(const Body& body, const SettingsSource& shape) {
  for (const Record& x : body.map->rest().values())
    for (double component : {x.x, x.y, x.z})
      if (!(std::abs(component) <= farthest))
        shape.fail("",
                   fmt::format("a vertex lies {:g} m from the origin; at most {:g} m are allowed",
                               std::abs(component), farthest),
                   "scale and translate of <place>, and the sizes of the shape, are in metres");
}

// The sum over all elements: the area of a sheet [m²], the volume of a solid [m³].
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

void check(const MassSettings& mass, bool sheet) {
  check_settings(mass);
  const SettingsSource& source = mass.source;
  if (mass.density && !mass.density_by_place.empty())
    source.fail("density", "<mass> has two densities, a number and an expression", "leave out one of them");
  if (mass.total.has_value() == mass.has_density())
    source.fail("", mass.total ? "<mass> has both total and density" : "<mass> needs total or density",
                sheet ? "total=\"0.1\", or density=\"300\" with thickness=\"0.001\""
                      : "total=\"0.1\", or density=\"1000\"");
  if (!sheet && mass.thickness)
    source.fail("thickness", "thickness of <mass> has no use in a solid, whose volume is known",
                "leave it out");
  if (sheet && mass.has_density() && !mass.thickness)
    source.fail("", "the density of a sheet needs its thickness", "thickness=\"0.001\"");
  if (mass.total && mass.thickness)
    source.fail("thickness", "thickness of <mass> has no use where the total mass is given",
                "leave it out, or give the density");
}

// Only a change that prepares the map asks for them (ChangeType::prepare).
KeepStart keep_start(const BodySettings& settings) {
  const bool asked = std::ranges::any_of(
      settings.tears, [](const LawSettings& law) { return law.change && law.change->prepare; });
  return asked ? KeepStart::Yes : KeepStart::No;
}

void build_mass(Body& body, const BodySettings& settings) {
  const MassSettings& how = settings.mass;
  const bool sheet = body.map->dimension() == 2;
  check(how, sheet);
  CornerMass mass;
  if (how.total)
    mass.density = *how.total / extent(*body.map);
  else
    mass.density = how.density.value_or(1) * (sheet ? *how.thickness : 1);
  if (how.density_by_place.empty()) {
    ElementExpression::refuse_unused(density_quantity(), how.source);
    body.mass = &body.map->add(mass.on(*body.map));
    return;
  }
  const auto density =
      std::make_shared<ElementExpression>(how.density_by_place, how.of_expression, density_quantity(),
                                          body_at_rest(body, settings, how.of_expression), how.source);
  mass.by_place = density;
  body.mass = &body.map->add(mass.on(*body.map));
  density->forget_groups();
}

// Which keeps texture coordinates of a mesh file also where an expression uses them.
ShapeSettings shape_to_make(const BodySettings& settings) {
  ShapeSettings shape = settings.shape;
  auto* const mesh = std::get_if<MeshSettings>(&shape);
  if (mesh && asks_for_picture_place(settings)) mesh->texture_coordinates = true;
  return shape;
}

} // namespace

void build_shape(Body& body, const BodySettings& settings) {
  check_settings(settings.place);
  std::visit(
      [&](const auto& shape) {
        const bool by_rules = !settings.applies.empty() || !settings.slits.empty() || settings.pieces;
        make_map(body, shape, by_rules ? Placement{} : settings.place);
        if (by_rules || body.map->map().dart_count() == 0)
          construct(body, settings.applies, settings.slits, settings.pieces, settings.rules, settings.place,
                    keep_start(settings), shape.source);
        check_reach(body, shape.source);
      },
      shape_to_make(settings));
  build_mass(body, settings);
}

} // namespace rend
