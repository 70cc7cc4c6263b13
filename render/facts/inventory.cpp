#include "render/facts/inventory.h"

#include "render/facts/left_out.h"
#include "render/facts/passes.h"
#include "sim/rows/frequency.h"
#include "sim/scene/memory.h"
#include "sim/topology/count.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {
namespace {

using Json = nlohmann::ordered_json;

Json time_json(const Session& session) {
  const Scene& scene = session.scene();
  double limit = std::numeric_limits<double>::infinity();
  FrequencyBounds all{0, 0, std::numeric_limits<double>::infinity()};
  for (const auto& body : scene.bodies()) {
    const FrequencyBounds b = frequency_bounds(*body->map, body->interactions, *body->mass, body->drag);
    all.omega_squared = std::max(all.omega_squared, b.omega_squared);
    all.damping_rate = std::max(all.damping_rate, b.damping_rate + body->uniform_drag);
    all.least_drag_rate = std::min(all.least_drag_rate, b.least_drag_rate + body->uniform_drag);
    limit = std::min(limit, scene.scheme().limit({b.omega_squared, b.damping_rate + body->uniform_drag,
                                                  b.least_drag_rate + body->uniform_drag}));
  }
  return {{"integrator", scene.scheme().name},
          {"order", scene.scheme().order},
          {"evaluations", scene.scheme().evaluations},
          {"step", scene.step_size()},
          {"from", scene.automatic_step() ? "auto" : "preset"},
          {"limit", std::isfinite(limit) ? Json(limit) : Json(nullptr)}, // [s]
          {"bounds", {{"omega", std::sqrt(all.omega_squared)}, {"damping_rate", all.damping_rate}}},
          {"duration", session.clock().duration()},
          {"steps", session.clock().steps()},
          {"fps", session.clock().fps()},
          {"frames", session.clock().frames()}};
}

Json orbit_json(Orbit orbit) {
  return {{"orbit", name(orbit)}, {"links", to_string(orbit)}};
}

Json slots_json(const EmbeddedMap& map) {
  Json all = Json::array();
  for (int mask = 0; mask < orbit_kinds; ++mask) {
    Orbit orbit;
    orbit.mask = static_cast<std::uint8_t>(mask);
    if (!map.uses(orbit)) continue;
    Json one = orbit_json(orbit);
    one["slots"] = map.cells(orbit).slots();
    one["bytes"] = map.cells(orbit).bytes();
    all.push_back(std::move(one));
  }
  return all;
}

Json embeddings_json(const EmbeddedMap& map) {
  Json all = Json::array();
  for (const auto& column : map.columns()) {
    Json one{{"name", column->name()}};
    one.update(orbit_json(column->orbit()));
    one["bytes"] = column->bytes();
    all.push_back(std::move(one));
  }
  return all;
}

Json interactions_json(const Program& program) {
  Json all = Json::array();
  const auto add = [&](const std::vector<Binder>& binders, const char* rows_are) {
    for (const Binder& binder : binders) {
      Json one{{"name", binder.interaction()->name}, {"rows_are", rows_are}};
      one.update(orbit_json(binder.pattern().owner));
      one["rows"] = binder.rows().live_count();
      one["bytes"] = binder.rows().bytes();
      all.push_back(std::move(one));
    }
  };
  add(program.folded(), program.options().fold ? "folded" : "each by itself");
  add(program.elementary(), "each by itself, into corners");
  return all;
}

Json laws_json(const Body& body) {
  Json all = Json::array();
  for (const TearLaw& law : body.tear_laws) {
    const LawSettings& s = law.settings();
    all.push_back({{"criterion", s.criterion->name},
                   {"what", s.criterion->what},
                   {"threshold", s.threshold},
                   {"unit", s.unit},
                   {"change", s.change->name},
                   {"bytes", law.bytes()}});
  }
  return all;
}

// Before the first step.
Json cells_json(const Body& body) {
  const GMap& map = body.map->map();
  const CellCounts counts = count_cells(map);
  return {{"name", body.name},
          {"kind", map.dimension() == 2 ? "sheet" : "solid"},
          {"vertices", counts.vertices},
          {"edges", counts.edges},
          {"elements", map.dimension() == 2 ? counts.faces : counts.volumes},
          {"darts", map.dart_count()},
          {"fragments", counts.fragments},
          {"euler", counts.euler},
          {"prescribed", body.constraints.vertices().size()}};
}

Json arrays_json(const std::vector<Holding>& arrays) {
  Json all = Json::array();
  for (const Holding& one : arrays)
    all.push_back({{"part", one.part}, {"name", one.name}, {"per", one.per}, {"bytes", one.bytes}});
  return all;
}

// By part, and of all.
Json bytes_json(const std::vector<Holding>& arrays) {
  Json bytes = Json::object();
  std::size_t total = 0;
  for (const std::string& part : footprint_parts()) {
    const std::size_t of_part = bytes_of_part(arrays, part);
    if (of_part > 0) bytes[part] = of_part;
    total += of_part;
  }
  bytes["total"] = total;
  return bytes;
}

void add_built(const Scene& scene, const Body& body, Json& json) {
  const std::vector<Holding> arrays = footprint_of(body);
  json["slots"] = slots_json(*body.map);
  json["embeddings"] = embeddings_json(*body.map);
  json["interactions"] = interactions_json(*body.program);
  json["laws"] = laws_json(body);
  json["arrays"] = arrays_json(arrays);
  json["bytes"] = bytes_json(arrays);
  json["left_out"] = left_out_of(scene, body);
  json["notes"] = body.notes;
  if (!body.assembly) return;
  const SolverFigures solver = body.integrator->solver();
  json["solver"] = {{"blocks", body.assembly->pattern()->blocks()},
                    {"newton", solver.newton},
                    {"cg", solver.cg},
                    {"factorisations", solver.factorisations}};
}

} // namespace

Json inventory_of(Session& session) {
  Scene& scene = session.scene();
  Json inventory{{"preset", session.preset_path()}, {"name", scene.name()}};
  if (session.preset().has("thesis")) inventory["thesis"] = session.preset().text("thesis");
  inventory["time"] = time_json(session);
  Json bodies = Json::array();
  for (const auto& body : scene.bodies()) bodies.push_back(cells_json(*body));
  inventory["first_step"] = nullptr; // or why it could not be made
  try {
    scene.step();
  } catch (const Unstable& error) {
    inventory["first_step"] = error.what();
  }
  std::vector<Holding> arrays = footprint_of(scene);
  inventory["arrays"] = arrays_json(arrays);
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const Body& body = *scene.bodies()[n];
    add_built(scene, body, bodies[n]);
    const std::vector<Holding> more = footprint_of(body);
    arrays.insert(arrays.end(), more.begin(), more.end());
  }
  inventory["bodies"] = std::move(bodies);
  inventory["bytes"] = bytes_json(arrays);
  inventory["step"] = passes_of(scene);
  inventory["left_out"] = left_out_of(scene);
  return inventory;
}

} // namespace rend
