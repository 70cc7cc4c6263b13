// The figures of a run as JSON.
#include "render/clip/figures.h"
#include "render/console/json_or_null.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace rend {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Vec3& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

Json json_of(const Reached& reached) {
  if (!(reached.value > 0)) return nullptr;
  return {{"value", reached.value}, {"time", reached.time}, {"place", json_of(reached.place)}};
}

Json json_of(const ReachFigures& reach) {
  return {{"body", reach.body},
          {"criterion", reach.criterion},
          {"unit", reach.unit},
          {"look_every", reach.look_every},
          {"reached", json_of(reach.reached)}};
}

Json json_of(const LawFigures& law) {
  Json out{{"body", law.body},
           {"criterion", law.criterion},
           {"change", law.change},
           {"threshold", law.threshold},
           {"unit", law.unit},
           {"tears", law.tears},
           {"first", json_or_null(law.first)},
           {"at_once", law.at_once.has_value()},
           {"reached", json_of(law.reached)},
           {"look_every", law.look_every},
           {"never", law.never == NeverTore::No ? Json(nullptr) : Json(name_of(law.never))},
           {"relative", law.is_relative}};
  for (const auto& [reason, count] : law.refusals) out["refused"][reason] = count;
  return out;
}

// Shares of the mass of all; the numbers of others that have at least a hundredth of it, and less.
Json json_of(const FragmentFigures& fragments) {
  return {{"largest", fragments.largest},
          {"others_above_1_percent", fragments.above},
          {"others_below_1_percent", fragments.below}};
}

Json json_of(const ProbeFigures& probe) {
  if (!probe.reading) return nullptr;
  const ProbeReading& reading = *probe.reading;
  Json out{{"position", json_of(reading.position)}, {"displacement", json_of(reading.displacement)}};
  if (reading.reaction) out["reaction"] = json_of(*reading.reaction);
  if (!reading.stress) return out;
  for (const char* part : {"xx", "yy", "zz", "xy", "yz", "xz"})
    out["stress"][part] = quantity_of(reading, std::string("stress-") + part);
  return out;
}

Json json_of(const AnswerFigures& answer) {
  return {{"probe", answer.probe},
          {"quantity", answer.quantity},
          {"at", answer.at},
          {"value", answer.value},
          {"measured", json_or_null(answer.measured)},
          {"error", json_or_null(answer.error)},
          {"tolerance", answer.tolerance},
          {"holds", json_or_null(answer.holds)},
          {"source", answer.source}};
}

Json json_of(const SphereFigures& sphere) {
  return {{"centre", json_of(sphere.centre)}, {"velocity", json_of(sphere.velocity)}};
}

// Steps that were thrown away, and what was done in their place.
Json json_of(const GuardFigures& g) {
  return {{"rejected", g.rejected}, {"redone", g.redone},     {"parts", g.most_substeps},
          {"smallest", g.smallest}, {"accepted", g.accepted}, {"looks", g.energy_tests}};
}

Json json_of(const SolvingFigures& solver) {
  return {{"newton", solver.all.newton},
          {"cg", solver.all.cg},
          {"factorisations", solver.all.factorisations},
          {"blocks", solver.blocks},
          {"bytes", solver.all.bytes}};
}

Json json_of(const ObstacleFigures& obstacle) {
  Json out{{"kind", obstacle.kind}, {"number", obstacle.number}};
  if (!obstacle.name.empty()) out["name"] = obstacle.name;
  out["touched"] = obstacle.touched;
  return out;
}

template <class T> Json list_of(const std::vector<T>& all) {
  Json list = Json::array();
  for (const T& one : all) list.push_back(json_of(one));
  return list;
}

// The distances: null where nothing was in contact.
Json json_of(const ContactWork& contact) {
  Json out{{"impact", contact.impact}, {"friction", contact.friction}, {"gap", nullptr}, {"overlap", nullptr}};
  if (std::isinf(contact.gap)) return out;
  out["gap"] = contact.gap;
  out["overlap"] = contact.overlap;
  return out;
}

Json json_of(const EnergyFigures& e) {
  const Work& w = e.now.work;
  return {{"kinetic", e.now.kinetic},
          {"elastic", e.now.elastic},
          {"gravity", e.now.gravity},
          {"work", w.sum()},
          {"work_of",
           {{"loads", w.loads},
            {"drives", w.drives},
            {"obstacles", w.contact.obstacles},
            {"changes", w.changes},
            {"remesh", w.remesh}}},
          {"contact", json_of(w.contact)},
          {"dissipated", e.dissipated},
          {"balance", e.balance}};
}

Json json_of(const StateFigures& s) {
  Json probes = Json::object(), rows = Json::object();
  for (const ProbeFigures& probe : s.probes) probes[probe.name] = json_of(probe);
  for (const auto& [name, count] : s.rows) rows[name] = count;
  Json state{{"steps", s.steps},
             {"evaluations", s.evaluations},
             {"time", s.time},
             {"vertices", s.vertices},
             {"elements", s.elements},
             {"darts", s.darts},
             {"fragments", s.fragments.count},
             {"fragment_sizes", json_of(s.fragments)},
             {"tears", s.tears},
             {"laws", list_of(s.laws)},
             {"energy", json_of(s.energy)},
             {"mass", s.mass},
             {"momentum", json_of(s.momentum)},
             {"angular_momentum", json_of(s.angular_momentum)},
             {"probes", std::move(probes)},
             {"answers", list_of(s.answers)}};
  if (!s.reach.empty()) state["reach"] = list_of(s.reach);
  for (const auto& [name, added] : s.added_mass) state["added_mass"][name] = added;
  if (!s.obstacles.empty()) state["obstacles"] = list_of(s.obstacles);
  if (s.touched_nothing) state["touched_nothing"] = *s.touched_nothing;
  if (!s.spheres.empty()) state["spheres"] = list_of(s.spheres);
  state["guard"] = json_of(s.guard);
  if (s.crossings)
    state["crossings"] = {
        {"tried", s.crossings->tried}, {"joined", s.crossings->joined}, {"left", s.crossings->left}};
  state["rows"] = std::move(rows);
  if (s.solver) state["solver"] = json_of(*s.solver);
  if (s.adaptive) state["adaptive"] = {{"parts", s.adaptive->substeps}, {"rejected", s.adaptive->rejected}};
  state["hash"] = fmt::format("{:016x}", s.hash);
  return state;
}

Json seconds_json(const Figures& figures) {
  const SceneSeconds& s = figures.seconds;
  const Costs& costs = figures.costs;
  return {{"total", costs.total},
          {"build", s.build},
          {"bind", s.bind},
          {"step", figures.step_seconds},
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

Json json_of(const MemoryFigures& bytes) {
  return {{"map", bytes.map},
          {"embeddings", bytes.embeddings},
          {"program", bytes.program},
          {"state", bytes.state},
          {"surroundings", bytes.surroundings},
          {"surface", bytes.surface},
          {"guard", bytes.guard},
          {"peak_rss", bytes.peak}};
}

Json json_of(const ExportFigures& exported) {
  Json out{{"format", exported.format}, {"folder", exported.folder}};
  if (!exported.index.empty()) out["index"] = exported.index;
  out["files"] = exported.files;
  out["bytes"] = exported.bytes;
  out["seconds"] = exported.seconds;
  return out;
}

} // namespace

Json json_of(const Figures& figures) {
  Json json{{"preset", figures.preset},
            {"name", figures.name},
            {"integrator", figures.integrator},
            {"step", figures.step},
            {"stopped", figures.stopped == Stopped::No ? Json(nullptr) : Json(name_of(figures.stopped))}};
  const Json state = json_of(figures.state);
  for (const auto& [name, figure] : state.items()) json[name] = figures.simulated ? figure : Json(nullptr);
  json["seconds"] = seconds_json(figures);
  json["bytes"] = json_of(figures.bytes);
  if (figures.exported) json["export"] = json_of(*figures.exported);
  if (!figures.pictures) return json;
  json["frames"] = figures.pictures->made;
  json["kept"] = figures.pictures->kept;
  return json;
}

} // namespace rend
