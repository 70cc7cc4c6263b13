#include "render/facts/passes.h"

#include "render/console/console.h"
#include "render/console/json_or_null.h"
#include "sim/base/enum_words.h"
#include "sim/base/printable.h"
#include "sim/scene/memory.h"
#include "sim/topology/count.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace rend {
namespace {

class Passes {
public:
  Passes(const Scene& scene, std::vector<Pass>& to) : scene_(scene), to_(to) {}

  void of(const Body& body) {
    body_ = &body;
    vertices_ = body.vertices() * sizeof(Record);
    const Program& program = *body.program;
    const bool elementary = !program.elementary().empty() && !body.view().corner_buffer;
    const double evaluations = evaluations_of(body);
    const std::size_t corner = elementary ? bytes_of(body.corner_force) : 0;
    add_forces(PassStage::Forces, elementary ? program.elementary() : program.rows(), 1, corner);
    if (evaluations > 1) add_forces(PassStage::FurtherForces, program.rows(), evaluations - 1, 0);
    add_loads(evaluations);
    add_laws();
    add_integration();
    if (body.floor_contact)
      add(PassStage::Contact, "the floor", body.vertices(), "vertices", 1, body.next.bytes());
  }

  void of_all() {
    body_ = nullptr;
    const Contacts* contacts = scene_.contacts();
    if (!contacts) return;
    for (const auto& each : contacts->bodies())
      if (each->faces)
        add(PassStage::Contact,
            each->body ? "obstacles, and " + each->body->name : scene_.world().called(each->obstacle->number),
            each->faces->triangles().size(), "triangles", 1, each->bytes());
    if (const TornSides* torn = contacts->torn_sides(); torn && torn->pairs() > 0)
      add(PassStage::Contact, "torn sides", torn->pairs(), "pairs", 1, torn->bytes());
    if (const FragmentContact* fragments = contacts->fragments())
      add(PassStage::Contact, "fragments and bodies", fragments->pairs(), "pairs", 1, fragments->bytes());
    if (const EdgeContact* edges = contacts->edges())
      add(PassStage::Contact, "edges", edges->pairs(), "pairs", 1, edges->bytes());
    if (const EdgeContact* edges = contacts->obstacle_edges())
      add(PassStage::Contact, "edges, and those of obstacles", edges->pairs(), "pairs", 1, edges->bytes());
  }

private:
  void add(PassStage stage, const std::string& what, std::size_t count, const char* of, double times,
           std::size_t bytes) {
    to_.push_back({.body = body_ ? std::optional(body_->name) : std::nullopt,
                   .stage = stage,
                   .what = what,
                   .count = count,
                   .of = of,
                   .times = times,
                   .bytes = bytes});
  }

  // Evaluations of the forces per step.
  double evaluations_of(const Body& body) const {
    const Scheme& scheme = scene_.scheme();
    return scheme.solves ? 1.0 + static_cast<double>(body.integrator->solver().newton) : scheme.evaluations;
  }

  void add_forces(PassStage stage, const std::vector<Binder>& binders, double times, std::size_t corners) {
    bool damped = false;
    for (const Binder& binder : binders) {
      damped = damped || binder.interaction()->damped;
      add(stage, binder.interaction()->name, binder.rows().live_count(), "rows", times, binder.rows().bytes());
    }
    add(stage, damped ? "positions, velocities; forces" : "positions; forces", body_->vertices(), "vertices",
        times, (damped ? 3 : 2) * vertices_ + corners);
  }

  void add_loads(double evaluations) {
    const Loads& loads = body_->loads;
    if (loads.empty()) return;
    bool constant = !loads.wind();
    std::size_t cells = loads.wind() ? loads.wind()->faces() : 0;
    for (const Load& load : loads.loads()) {
      constant = constant && load.constant() && load.settings().until <= load.settings().from;
      cells += load.cells();
    }
    add(PassStage::Loads, constant ? "constant: summed up once" : "of the state, and their sum", cells, "cells",
        constant ? 0 : evaluations, loads.bytes());
  }

  void add_laws() {
    const GMap& map = body_->map->map();
    for (const TearLaw& law : body_->tear_laws) {
      const LawSettings& settings = law.settings();
      add(PassStage::Laws, settings.criterion->name, count_cells(map, orbit_of(settings.cell, map.dimension())),
          "cells", 1, law.bytes() + vertices_);
    }
  }

  void add_integration() {
    const std::vector<MemoryEntry> all = footprint_of(*body_);
    const std::size_t weights = body_->vertices() * sizeof(double) * (body_->drag_rate ? 2 : 1);
    const std::size_t loads = body_->load ? vertices_ : 0;
    if (const std::size_t bytes = bytes_of_part(all, "solver"))
      add(PassStage::Solve, "matrix and factors, preconditioner", body_->assembly->pattern()->blocks(),
          "blocks", static_cast<double>(body_->integrator->solver().newton), bytes);
    add(PassStage::Integration, scene_.scheme().name, body_->vertices(), "vertices", 1,
        3 * vertices_ + loads + weights + body_->next.bytes() + bytes_of_part(all, "integrator"));
    if (const auto held = body_->constraints.vertices().size())
      add(PassStage::Integration, "prescribed motions", held, "vertices", scene_.scheme().evaluations,
          body_->constraints.bytes() + held * 3 * sizeof(Record));
  }

  const Scene& scene_;
  std::vector<Pass>& to_;
  const Body* body_ = nullptr;
  std::size_t vertices_ = 0; // bytes of one Record for each vertex slot
};

} // namespace

const char* name_of(PassStage stage) {
  static constexpr EnumWords<PassStage::Contact> words{"forces", "further forces", "loads",  "laws",
                                                       "solve",  "integration",    "contact"};
  return words[stage];
}

std::vector<Pass> passes_of(const Scene& scene) {
  std::vector<Pass> all;
  Passes passes(scene, all);
  for (const auto& body : scene.bodies()) passes.of(*body);
  passes.of_all();
  return all;
}

nlohmann::ordered_json json_of(const std::vector<Pass>& passes) {
  using Json = nlohmann::ordered_json;
  Json all = Json::array();
  for (const Pass& pass : passes)
    all.push_back({{"body", json_or_null(pass.body)},
                   {"stage", name_of(pass.stage)},
                   {"what", pass.what},
                   {"count", pass.count},
                   {"of", pass.of},
                   {"times", pass.times},
                   {"bytes", pass.bytes}});
  return all;
}

std::string passes_in_words(const std::vector<Pass>& passes) {
  std::string out = fmt::format("\n{:<72}{:>8}{:>20}\n", "a step, in this order", "times", "bytes each time");
  double whole_step = 0;
  std::optional<PassStage> last;
  for (const Pass& pass : passes) {
    whole_step += pass.times * static_cast<double>(pass.bytes);
    out += fmt::format("  {:<16}{:<36}{:>9} {:<9}{:>7g}{:>20}\n", pass.stage == last ? "" : name_of(pass.stage),
                       printable(pass.what), pass.count, pass.of, pass.times, pass.bytes);
    last = pass.stage;
  }
  return out + fmt::format("  {:<78}{:>20}\n", "and in sum, each array counted once a pass",
                           bytes_in_words(static_cast<std::size_t>(whole_step)));
}

} // namespace rend
