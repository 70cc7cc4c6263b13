#include "sim/build/build_motion.h"

#include "sim/base/math.h"
#include "sim/mechanics/mass.h"

#include <fmt/format.h>

namespace rend {
namespace {

void add_motion(Body& body, const FixSettings& fix) {
  body.constraints.add(*body.map, motion_of(fix),
                       select_vertices(*body.map, body.groups, fix.where, "fix", fix.source));
}

void add_motion(Body& body, const DriveSettings& drive) {
  body.constraints.add(*body.map, motion_of(drive),
                       select_vertices(*body.map, body.groups, drive.where, "drive", drive.source));
}

void build_constraints(Body& body, const std::vector<MotionSettings>& motions) {
  for (const MotionSettings& motion : motions)
    std::visit(
        [&](const auto& settings) {
          check_settings(settings);
          if (body.constraints.motions().size() == 64)
            settings.source.fail("", "a body takes at most 64 <fix> and <drive>");
          add_motion(body, settings);
        },
        motion);
  if (body.constraints.motions().empty()) body.left_out.emplace_back("prescribed motions: no fix and no drive");
}

Load load_of(Body& body, const LoadSettings& settings) {
  using Kind = LoadSettings::Kind;
  check_settings(settings);
  check_load(settings);
  const std::vector<Slot> vertices =
      select_vertices(*body.map, body.groups, settings.where, "load", settings.source);
  const std::string name = fmt::format("load {}", body.loads.loads().size() + 1);
  if (settings.kind() == Kind::Pressure) {
    Patch patch = Patch::faces(*body.map, name, vertices);
    if (patch.cells().size() == 0)
      settings.source.fail("pressure", "no face has all of its vertices selected", "select more of the body");
    return {*body.map, settings, std::move(patch)};
  }
  Load load(*body.map, settings, Patch::boundary(*body.map, name, vertices));
  if (settings.kind() == Kind::Moment && !load.possible(*body.map))
    settings.source.fail("moment", "a moment needs vertices that do not all lie on one straight line",
                         "select more of them, such as the whole last row of cells instead of its border");
  return load;
}

void build_loads(Body& body, const std::vector<LoadSettings>& loads) {
  for (const LoadSettings& load : loads) body.loads.add(load_of(body, load));
  if (body.loads.empty()) body.left_out.emplace_back("external forces: no load");
}

void start_moving(Body& body, const Placement& place) {
  if (place.velocity.isZero(0) && place.spin.isZero(0)) return;
  EmbeddedMap& map = *body.map;
  const CellIndex& cells = map.cells(Vertex);
  const auto mass_of = [&](Slot v) {
    return sum_at_vertex(map, body.mass->orbit(), body.mass->values(), cells.first_dart(v));
  };
  Vec3 centre = Vec3::Zero();
  double whole = 0;
  for (Slot v = 0; v < cells.slots(); ++v) {
    if (!cells.alive(v)) continue;
    const double m = mass_of(v);
    centre += m * map.position()[v].vec();
    whole += m;
  }
  centre /= whole;
  const Vec3 spin = place.spin * (pi / 180);
  for (Slot v = 0; v < cells.slots(); ++v)
    if (cells.alive(v))
      map.velocity().values()[v] = Record(place.velocity + spin.cross(map.position()[v].vec() - centre));
}

} // namespace

void build_motion(Body& body, const BodySettings& settings) {
  build_constraints(body, settings.motions);
  build_loads(body, settings.loads);
  start_moving(body, settings.place);
}

} // namespace rend
