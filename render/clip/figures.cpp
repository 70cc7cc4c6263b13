#include "render/clip/figures.h"

#include "render/clip/early_tears.h"
#include "sim/body/fragment_masses.h"
#include "sim/fracture/pairs.h"
#include "sim/scene/memory.h"
#include "sim/topology/count.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rend {
namespace {

std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024; // Linux counts in KiB
}

std::size_t elements_of(const Body& body) {
  return count_cells(body.map->map(), body.map->dimension() == 2 ? FaceOfVolume : Volume);
}

MemoryFigures bytes_of(const Scene& scene, const Costs& costs) {
  std::vector<MemoryEntry> all = footprint_of(scene);
  for (const auto& body : scene.bodies()) {
    const std::vector<MemoryEntry> more = footprint_of(*body);
    all.insert(all.end(), more.begin(), more.end());
  }
  const auto of = [&](std::initializer_list<const char*> parts) {
    std::size_t sum = 0;
    for (const char* part : parts) sum += bytes_of_part(all, part);
    return sum;
  };
  return {.map = of({"map"}),
          .embeddings = of({"slots", "embeddings"}),
          .program = of({"program", "laws", "solver"}),
          .state = of({"state", "integrator"}),
          .surroundings = of({"constraints", "loads", "contact"}),
          .surface = costs.surface_bytes,
          .guard = of({"guard"}),
          .peak = peak_memory()};
}

std::vector<std::pair<std::string, std::size_t>> rows_of(const Scene& scene) {
  std::vector<std::pair<std::string, std::size_t>> rows;
  for (const auto& body : scene.bodies()) {
    const Program& program = *body->program;
    for (const Binder& binder : program.folded().empty() ? program.elementary() : program.folded()) {
      const std::string& name = binder.interaction()->name;
      auto at = std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.first == name; });
      if (at == rows.end()) at = rows.insert(at, {name, 0});
      at->second += binder.rows().live_count();
    }
  }
  return rows;
}

std::vector<ProbeFigures> probes_of(const Scene& scene) {
  std::vector<ProbeFigures> probes;
  for (const auto& body : scene.bodies())
    for (const Probe& probe : body->probes) probes.push_back({probe.name(), probe.read(*body)});
  return probes;
}

std::vector<AnswerFigures> answers_of(const Scene& scene) {
  std::vector<AnswerFigures> answers;
  for (const auto& body : scene.bodies()) {
    for (const Answer& answer : body->answers) {
      AnswerFigures one{.probe = answer.probe,
                        .quantity = answer.quantity,
                        .at = answer.at,
                        .value = answer.value,
                        .tolerance = answer.tolerance,
                        .measured = answer.measured,
                        .error = {},
                        .holds = {},
                        .source = answer.known_from};
      if (answer.measured) one.error = answer.error();
      if (answer.asked) one.holds = answer.holds();
      answers.push_back(std::move(one));
    }
  }
  return answers;
}

FragmentFigures fragments_of(const Scene& scene) {
  std::vector<double> masses;
  for (const auto& body : scene.bodies()) {
    const std::vector<double> own = fragment_masses(*body->map, *body->mass);
    masses.insert(masses.end(), own.begin(), own.end());
  }
  FragmentFigures out{.count = masses.size()};
  if (masses.empty()) return out;
  const double all = std::accumulate(masses.begin(), masses.end(), 0.0);
  const auto largest = std::max_element(masses.begin(), masses.end());
  out.largest = all > 0 ? *largest / all : 0;
  for (auto mass = masses.begin(); mass != masses.end(); ++mass)
    if (mass != largest) ++(*mass >= FragmentFigures::small * all ? out.above : out.below);
  return out;
}

// The steps of a law, from the first to the last; none if the last is before the first. They begin at multiples
// of the step.
struct StepsOfLaw {
  double first, last;

  StepsOfLaw(const Session& session, const LawSettings& law) {
    const double step = session.scene().step_size(), slack = 1e-9;
    first = std::ceil(law.from / step - slack);
    last =
        std::min(std::floor(law.until / step + slack), static_cast<double>(session.scene().steps_done() - 1));
  }
  bool any() const { return first <= last; }
  // Whether values below the threshold were looked at in one of them.
  bool sampled(long every) const {
    return std::floor(last / static_cast<double>(every)) * static_cast<double>(every) >= first;
  }
};

NeverTore why_never(const Session& session, const LawFigures& law, const LawSettings& settings) {
  if (law.tears > 0) return NeverTore::No;
  if (law.reached.value > law.threshold) return NeverTore::NotPossible;
  if (law.reached.value > 0) return NeverTore::Below;
  const StepsOfLaw steps(session, settings);
  if (!steps.any()) return NeverTore::NotInTime;
  return steps.sampled(law.look_every) ? NeverTore::NoValue : NeverTore::Below;
}

std::vector<LawFigures> laws_of(const Session& session) {
  const Scene& scene = session.scene();
  std::vector<LawFigures> laws;
  for (const auto& body : scene.bodies()) {
    for (std::size_t n = 0; n < body->tear_laws.size(); ++n) {
      const LawSettings& law = body->tear_laws[n].settings();
      LawFigures one{.body = body->name,
                     .criterion = law.criterion->name,
                     .change = law.change->name,
                     .threshold = law.threshold,
                     .unit = law.unit,
                     .tears = 0,
                     .first = {},
                     .at_once = {},
                     .from = law.from,
                     .until = law.until,
                     .selects = law.strength.where.given(),
                     .is_relative = body->tear_laws[n].differs_by_strength(),
                     .refusals = body->tear_laws[n].refusals(),
                     .reached = body->tear_laws[n].reached(),
                     .look_every = body->look_every};
      for (const TearEvent& event : body->events) {
        if (event.law != static_cast<int>(n)) continue;
        if (one.tears++ > 0) continue;
        one.first = event.time;
        one.at_once = early_step(session, body->tear_laws[n], event);
      }
      one.never = why_never(session, one, law);
      laws.push_back(std::move(one));
    }
  }
  return laws;
}

// Of a scene whose laws only watch (SceneOptions::reach).
std::vector<ReachFigures> reach_of(const Scene& scene) {
  std::vector<ReachFigures> all;
  for (const auto& body : scene.bodies())
    for (const TearLaw& law : body->tear_laws) {
      const LawSettings& settings = law.settings();
      all.push_back({.body = body->name,
                     .criterion = NamedCriterion{settings.criterion, settings.kind}.name(),
                     .unit = settings.unit,
                     .look_every = body->look_every,
                     .reached = law.reached()});
    }
  return all;
}

std::vector<SphereFigures> spheres_of(const Scene& scene) {
  std::vector<SphereFigures> spheres;
  for (const Sphere& sphere : scene.world().spheres)
    if (sphere.moves()) spheres.push_back({sphere.centre, sphere.velocity});
  return spheres;
}

SolvingFigures solver_of(const Scene& scene) {
  SolvingFigures sum;
  for (const auto& body : scene.bodies()) {
    const SolverFigures one = body->integrator->solver();
    sum.all.newton += one.newton;
    sum.all.cg += one.cg;
    sum.all.factorisations += one.factorisations;
    sum.all.bytes += one.bytes + body->assembly->bytes();
    sum.blocks += body->pattern()->blocks();
  }
  return sum;
}

SolverFigures adaptive_of(const Scene& scene) {
  SolverFigures sum;
  for (const auto& body : scene.bodies()) {
    const SolverFigures one = body->integrator->solver();
    sum.substeps += one.substeps;
    sum.rejected += one.rejected;
  }
  return sum;
}

StateFigures state_of(const Session& session) {
  const Scene& scene = session.scene();
  StateFigures state;
  state.steps = scene.steps_done();
  state.evaluations = scene.evaluations();
  state.time = scene.time();
  for (const auto& body : scene.bodies()) {
    state.vertices += body->map->cells(Vertex).count();
    state.elements += elements_of(*body);
    state.darts += body->map->map().dart_count();
    if (body->added_mass > 0) state.added_mass.emplace_back(body->name, body->added_mass);
  }
  state.fragments = fragments_of(scene);
  state.tears = scene.tears();
  if (session.reaches())
    state.reach = reach_of(scene);
  else
    state.laws = laws_of(session);
  state.energy = scene.energy();
  state.falling = std::ranges::any_of(scene.world().spheres, [](const Sphere& one) { return one.falls(); });
  state.mass = scene.mass();
  state.momentum = scene.momentum();
  state.angular_momentum = scene.angular_momentum();
  state.probes = probes_of(scene);
  state.answers = answers_of(scene);
  state.touched_nothing = touched_nothing(scene);
  state.obstacles = obstacles_of(scene);
  state.spheres = spheres_of(scene);
  state.guard = scene.guard();
  if (scene.contacts() && scene.contacts()->guard()) state.crossings = scene.contacts()->guard()->figures();
  state.rows = rows_of(scene);
  if (scene.scheme().solves) state.solver = solver_of(scene);
  if (scene.scheme().adaptive) state.adaptive = adaptive_of(scene);
  state.hash = scene.hash();
  return state;
}

} // namespace

std::string_view name_of(NeverTore why) {
  switch (why) {
  case NeverTore::No:
    return "";
  case NeverTore::NotInTime:
    return "not in time";
  case NeverTore::NoValue:
    return "no value";
  case NeverTore::Below:
    return "below threshold";
  case NeverTore::NotPossible:
    return "not possible";
  }
  return "";
}

Figures figures_of(const Session& session, Stopped stopped, const Costs& costs) {
  const Scene& scene = session.scene();
  Figures figures;
  figures.preset = session.preset_path();
  figures.name = scene.name();
  figures.integrator = scene.scheme().name;
  figures.step = scene.step_size();
  figures.stopped = stopped;
  figures.state = state_of(session);
  figures.seconds = scene.seconds();
  figures.step_seconds = session.step_seconds();
  figures.costs = costs;
  figures.bytes = bytes_of(scene, costs);
  return figures;
}

} // namespace rend
