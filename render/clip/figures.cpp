#include "render/clip/figures.h"

#include "render/console/console.h"
#include "sim/base/printable.h"
#include "sim/scene/memory.h"
#include "sim/topology/count.h"

#include <fmt/format.h>

#include <sys/resource.h>

#include <algorithm>

namespace rend {
namespace {

using Json = nlohmann::ordered_json;

Json list_of(const Vec3& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024; // Linux counts in KiB
}

std::size_t elements_of(const Body& body) {
  return count_cells(body.map->map(), body.map->dimension() == 2 ? FaceOfVolume : Volume);
}

Json seconds_json(const Session& session, const Costs& costs) {
  const SceneSeconds s = session.scene().seconds();
  return {{"total", costs.total},
          {"build", s.build},
          {"bind", s.bind},
          {"step", session.step_seconds()},
          {"forces", s.forces},
          {"criteria", s.criteria},
          {"change", s.change},
          {"rebind", s.rebind},
          {"integrate", s.integrate},
          {"surface", costs.surface},
          {"draw", costs.pictures.draw},
          {"png", costs.pictures.png},
          {"video", costs.pictures.video}};
}

Json bytes_json(const Scene& scene, const Costs& costs) {
  std::vector<Holding> all = footprint_of(scene);
  for (const auto& body : scene.bodies()) {
    const std::vector<Holding> more = footprint_of(*body);
    all.insert(all.end(), more.begin(), more.end());
  }
  const auto of = [&](std::initializer_list<const char*> parts) {
    std::size_t sum = 0;
    for (const char* part : parts) sum += bytes_of_part(all, part);
    return sum;
  };
  return {{"map", of({"map"})},
          {"embeddings", of({"slots", "embeddings"})},
          {"program", of({"program", "laws", "solver"})},
          {"state", of({"state", "integrator"})},
          {"surroundings", of({"constraints", "loads", "contact"})},
          {"surface", costs.surface_bytes},
          {"guard", of({"guard"})},
          {"peak_rss", peak_memory()}};
}

// Steps that were thrown away, and what was done in their place.
Json guard_json(const Scene& scene) {
  const GuardFigures& g = scene.guard();
  return {{"rejected", g.rejected}, {"redone", g.redone},     {"parts", g.most_parts},
          {"smallest", g.smallest}, {"accepted", g.accepted}, {"looks", g.looks}};
}

std::string guard_in_words(const Json& guard) {
  if (guard["rejected"].get<long>() == 0) return "";
  return fmt::format("  guard      {} steps rejected, {} parts of steps in their place, of {:.3g} s and more\n",
                     guard["rejected"].get<long>(), guard["redone"].get<long>(),
                     guard["smallest"].get<double>());
}

// Live rows of what the integrator evaluates, by interaction.
Json rows_json(const Scene& scene) {
  Json rows = Json::object();
  for (const auto& body : scene.bodies()) {
    const Program& program = *body->program;
    for (const Binder& binder : program.folded().empty() ? program.elementary() : program.folded()) {
      Json& count = rows[binder.interaction()->name];
      count = (count.is_null() ? std::size_t{0} : count.get<std::size_t>()) + binder.rows().live_count();
    }
  }
  return rows;
}

Json probes_json(const Scene& scene) {
  Json probes = Json::object();
  for (const auto& body : scene.bodies()) {
    for (const Probe& probe : body->probes) {
      Json& out = probes[probe.name()]; // null: its vertices were deleted
      const auto reading = probe.read(*body);
      if (!reading) continue;
      out["position"] = list_of(reading->position);
      out["displacement"] = list_of(reading->displacement);
      if (reading->reaction) out["reaction"] = list_of(*reading->reaction);
      if (!reading->stress) continue;
      for (const char* part : {"xx", "yy", "zz", "xy", "yz", "xz"})
        out["stress"][part] = quantity_of(*reading, std::string("stress-") + part);
    }
  }
  return probes;
}

std::string probes_in_words(const Json& probes) {
  std::string out;
  const auto triple = [](const Json& v) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
  };
  for (const auto& [name, probe] : probes.items()) {
    out += fmt::format("{}{} ", out.empty() ? "  probes     " : "             ", name);
    if (probe.is_null()) {
      out += "has lost its vertices\n";
      continue;
    }
    out += "at " + triple(probe["position"]) + " m, displaced by " + triple(probe["displacement"]) + " m";
    if (probe.contains("reaction")) out += ", held by " + triple(probe["reaction"]) + " N";
    out += "\n";
  }
  return out;
}

// What was not reached is neither held nor broken: null.
Json answers_json(const Scene& scene) {
  Json answers = Json::array();
  for (const auto& body : scene.bodies()) {
    for (const Answer& answer : body->answers) {
      const bool known = answer.measured.has_value();
      answers.push_back({{"probe", body->probes[answer.probe].name()},
                         {"quantity", answer.quantity},
                         {"at", answer.at},
                         {"value", answer.value},
                         {"measured", known ? Json(*answer.measured) : Json(nullptr)},
                         {"error", known ? Json(answer.error()) : Json(nullptr)},
                         {"tolerance", answer.tolerance},
                         {"holds", answer.asked ? Json(answer.holds()) : Json(nullptr)},
                         {"source", answer.source}});
    }
  }
  return answers;
}

// What each law did, whether it did anything or not.
Json laws_json(const Scene& scene) {
  Json laws = Json::array();
  for (const auto& body : scene.bodies()) {
    for (std::size_t n = 0; n < body->tear_laws.size(); ++n) {
      const LawSettings& law = body->tear_laws[n].settings();
      const auto made = [&](const TearEvent& event) { return event.law == static_cast<int>(n); };
      const auto first = std::find_if(body->events.begin(), body->events.end(), made);
      laws.push_back({{"body", body->name},
                      {"criterion", law.criterion->name},
                      {"change", law.change->name},
                      {"threshold", law.threshold},
                      {"unit", law.unit},
                      {"tears", std::count_if(body->events.begin(), body->events.end(), made)},
                      {"first", first == body->events.end() ? Json(nullptr) : Json(first->time)}});
    }
  }
  return laws;
}

std::string laws_in_words(const Json& laws) {
  std::string out;
  for (const Json& law : laws) {
    const auto text = [&](const char* name) { return printable(law[name].get<std::string>()); };
    const auto tears = law["tears"].get<std::size_t>();
    out += fmt::format("             {} of '{}' above {:.6g} {}, {}: {}", text("criterion"), text("body"),
                       law["threshold"].get<double>(), text("unit"), text("change"),
                       tears == 0   ? "never"
                       : tears == 1 ? "once"
                                    : fmt::format("{} times", tears));
    if (tears > 0) out += fmt::format(", first at {:.6g} s", law["first"].get<double>());
    out += "\n";
  }
  return out;
}

std::string answers_in_words(const Json& answers) {
  std::string out;
  for (const Json& a : answers) {
    out += fmt::format("{}{} {} at {:.6g} s is {:.9g}", out.empty() ? "  answers    " : "             ",
                       a["probe"].get<std::string>(), a["quantity"].get<std::string>(), a["at"].get<double>(),
                       a["value"].get<double>());
    const bool relative = a["value"].get<double>() != 0;
    if (a["holds"].is_null())
      out += ": not reached";
    else if (a["measured"].is_null())
      out += ": its vertices are gone";
    else
      out += fmt::format(", measured {:.9g}: {} of {:.2g} {} {:.2g}", a["measured"].get<double>(),
                         relative ? "a relative error" : "an error", a["error"].get<double>(),
                         a["holds"].get<bool>() ? "holds, within" : "DOES NOT HOLD, above",
                         a["tolerance"].get<double>());
    if (const auto source = a["source"].get<std::string>(); !source.empty())
      out += fmt::format(" ({})", printable(source));
    out += "\n";
  }
  return out;
}

// Those that move, in the order of the preset.
Json spheres_json(const Scene& scene) {
  Json spheres = Json::array();
  for (const Sphere& sphere : scene.world().spheres)
    if (sphere.moves())
      spheres.push_back({{"centre", list_of(sphere.centre)}, {"velocity", list_of(sphere.velocity)}});
  return spheres;
}

// What the integrators' solving took; null where none solves.
Json solver_json(const Scene& scene) {
  if (!scene.scheme().solves) return nullptr;
  SolverFigures all;
  std::size_t blocks = 0;
  for (const auto& body : scene.bodies()) {
    const SolverFigures one = body->integrator->solver();
    all.newton += one.newton;
    all.cg += one.cg;
    all.factorisations += one.factorisations;
    all.bytes += one.bytes + body->assembly->bytes();
    blocks += body->pattern()->blocks();
  }
  return {{"newton", all.newton},
          {"cg", all.cg},
          {"factorisations", all.factorisations},
          {"blocks", blocks},
          {"bytes", all.bytes}};
}

// How an adaptive integrator cut its steps, over all bodies.
Json adaptive_json(const Scene& scene) {
  long parts = 0, rejected = 0;
  for (const auto& body : scene.bodies()) {
    const SolverFigures one = body->integrator->solver();
    parts += one.parts;
    rejected += one.rejected;
  }
  return {{"parts", parts}, {"rejected", rejected}};
}

// All that a state is known by: what a run that simulates nothing cannot tell.
Json state_json(const Scene& scene) {
  std::size_t vertices = 0, elements = 0, darts = 0;
  for (const auto& body : scene.bodies()) {
    vertices += body->map->cells(Vertex).count();
    elements += elements_of(*body);
    darts += body->map->map().dart_count();
  }
  Json state{{"steps", scene.steps_done()},
             {"evaluations", scene.evaluations()},
             {"time", scene.time()},
             {"vertices", vertices},
             {"elements", elements},
             {"darts", darts},
             {"fragments", scene.fragments()},
             {"tears", scene.tears()},
             {"laws", laws_json(scene)},
             {"energy",
              {{"kinetic", scene.kinetic_energy()},
               {"elastic", scene.elastic_energy()},
               {"gravity", scene.gravity_energy()}}},
             {"mass", scene.mass()},
             {"momentum", list_of(scene.momentum())},
             {"angular_momentum", list_of(scene.angular_momentum())},
             {"probes", probes_json(scene)},
             {"answers", answers_json(scene)}};
  if (Json spheres = spheres_json(scene); !spheres.empty()) state["spheres"] = std::move(spheres);
  state["guard"] = guard_json(scene);
  state["rows"] = rows_json(scene);
  if (Json solver = solver_json(scene); !solver.is_null()) state["solver"] = std::move(solver);
  if (scene.scheme().adaptive) state["adaptive"] = adaptive_json(scene);
  state["hash"] = fmt::format("{:016x}", scene.hash());
  return state;
}

} // namespace

Json figures_of(const Session& session, Stopped stopped, const Costs& costs, bool simulated) {
  const Scene& scene = session.scene();
  Json figures{{"preset", session.preset_path()},
               {"name", scene.name()},
               {"integrator", scene.scheme().name},
               {"step", scene.step_size()},
               {"stopped", stopped == Stopped::Unstable      ? Json("unstable")
                           : stopped == Stopped::Interrupted ? Json("interrupted")
                                                             : Json(nullptr)}};
  const Json state = state_json(scene);
  for (const auto& [name, figure] : state.items()) figures[name] = simulated ? figure : Json(nullptr);
  figures["seconds"] = seconds_json(session, costs);
  figures["bytes"] = bytes_json(scene, costs);
  return figures;
}

std::string summary_of(const Json& f) {
  const auto number = [&](const char* group, const char* name) { return f[group][name].get<double>(); };
  const auto count = [&](const char* name) { return f[name].get<std::size_t>(); };
  std::string out = fmt::format("{}: {} steps of {:.6g} s by {}, {:.6g} s simulated in {}\n",
                                printable(f["name"].get<std::string>()), count("steps"),
                                f["step"].get<double>(), f["integrator"].get<std::string>(),
                                f["time"].get<double>(), seconds_in_words(number("seconds", "total")));
  if (!f["stopped"].is_null()) out += fmt::format("  stopped    {}\n", f["stopped"].get<std::string>());
  out += fmt::format("  cells      {} vertices, {} elements, {} darts\n", count("vertices"), count("elements"),
                     count("darts"));
  out += fmt::format("  tearing    {} tears, {} fragment{}\n", count("tears"), count("fragments"),
                     count("fragments") == 1 ? "" : "s");
  out += laws_in_words(f["laws"]);
  out += fmt::format("  energy     {:.6g} J kinetic, {:.6g} J elastic, {:.6g} J in gravity\n",
                     number("energy", "kinetic"), number("energy", "elastic"), number("energy", "gravity"));
  out += guard_in_words(f["guard"]);
  out += fmt::format("  forces     evaluated {} times\n", f["evaluations"].get<long>());
  out += "  rows       ";
  for (const auto& [name, rows] : f["rows"].items())
    out += fmt::format("{}{} {}", name == f["rows"].items().begin().key() ? "" : ", ", rows.get<std::size_t>(),
                       name);
  if (f["rows"].empty()) out += "none";
  if (f.contains("solver"))
    out += fmt::format("\n  solver     {} Newton iterations, {} of conjugate gradients, {} factorisations",
                       f["solver"]["newton"].get<long>(), f["solver"]["cg"].get<long>(),
                       f["solver"]["factorisations"].get<long>());
  if (f.contains("adaptive"))
    out += fmt::format("\n  adaptive   {} parts of steps, {} more rejected for their error",
                       f["adaptive"]["parts"].get<long>(), f["adaptive"]["rejected"].get<long>());
  std::size_t bytes = 0;
  for (const char* part : {"map", "embeddings", "program", "state", "surroundings", "surface", "guard"})
    bytes += f["bytes"][part].get<std::size_t>();
  out += fmt::format("\n  memory     {} for the scene, {} at most in all\n", bytes_in_words(bytes),
                     bytes_in_words(f["bytes"]["peak_rss"].get<std::size_t>()));
  out += fmt::format("  state      {}\n", f["hash"].get<std::string>());
  if (f.contains("export"))
    out += fmt::format("  exported   {} files ({}) in {}\n", f["export"]["files"].get<std::size_t>(),
                       bytes_in_words(f["export"]["bytes"].get<std::size_t>()),
                       printable(f["export"]["folder"].get<std::string>()));
  out += probes_in_words(f["probes"]);
  out += answers_in_words(f["answers"]);
  return out;
}

} // namespace rend
