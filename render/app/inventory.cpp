#include "render/app/inventory.h"

#include "render/app/console.h"
#include "sim/program/frequency.h"
#include "sim/topology/count.h"

#include <fmt/format.h>

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
  for (const TearLaw& law : body.laws) {
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

Json body_json(const Body& body) {
  const EmbeddedMap& map = *body.map;
  const CellCounts counts = count_cells(map.map());
  std::size_t laws = 0;
  for (const TearLaw& law : body.laws) laws += law.bytes();
  Json json = {
      {"name", body.name},
      {"kind", map.dimension() == 2 ? "sheet" : "solid"},
      {"vertices", counts.vertices},
      {"edges", counts.edges},
      {"elements", map.dimension() == 2 ? counts.faces : counts.volumes},
      {"darts", map.map().dart_count()},
      {"fragments", counts.fragments},
      {"euler", counts.euler},
      {"prescribed", body.constraints.vertices().size()},
      {"slots", slots_json(map)},
      {"embeddings", embeddings_json(map)},
      {"interactions", interactions_json(*body.program)},
      {"laws", laws_json(body)},
      {"bytes",
       {{"map", map.map().bytes()}, {"embeddings", map.bytes()}, {"program", body.program->bytes() + laws}}},
      {"left_out", body.left_out},
      {"notes", body.notes}};
  if (body.assembly) // the rest comes with the first step
    json["solver"] = {{"blocks", body.assembly->pattern()->blocks()},
                      {"matrix_bytes", body.assembly->pattern()->blocks() * sizeof(Block3)},
                      {"pattern_bytes", body.assembly->bytes()}};
  return json;
}

// Lines of at most 100 columns, the first after `head`, the others below its end.
std::string folded(const std::string& head, const std::string& text) {
  constexpr std::size_t columns = 100;
  std::string out, line = head;
  bool bare = true; // nothing stands on the line yet
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string token = text.substr(at, end - at);
    if (!bare && line.size() + 1 + token.size() > columns) {
      out += line + '\n';
      line.assign(head.size(), ' ');
      bare = true;
    }
    line += (bare ? "" : " ") + token;
    bare = false;
    at = end + 1;
  }
  return out + line + '\n';
}

std::string text(const Json& json, const char* key) {
  return json[key].get<std::string>();
}
std::size_t whole(const Json& json, const char* key) {
  return json[key].get<std::size_t>();
}
double real(const Json& json, const char* key) {
  return json[key].get<double>();
}

std::string time_in_words(const Json& time) {
  std::string step = fmt::format("{:.6g} s a step by {} (order {}, {} evaluation{})", real(time, "step"),
                                 text(time, "integrator"), whole(time, "order"), whole(time, "evaluations"),
                                 whole(time, "evaluations") == 1 ? "" : "s");
  if (text(time, "from") == "auto")
    step += "; auto: 0.9 of the largest that is stable at rest";
  else
    step += "; given by the preset";
  if (time["limit"].is_null())
    step += "; nothing limits it";
  else if (real(time, "limit") > 0)
    step += fmt::format("; stable at rest: up to {:.3g} s", real(time, "limit"));
  else
    step += "; no step is stable";
  step += fmt::format(", from modes of at most {:.4g} rad/s, damped at most {:.4g}/s",
                      real(time["bounds"], "omega"), real(time["bounds"], "damping_rate"));
  return folded("time      ", step) +
         fmt::format("          {:.6g} s in {} steps; {} frames at {:g} a second\n", real(time, "duration"),
                     whole(time, "steps"), whole(time, "frames"), real(time, "fps"));
}

std::string orbit_in_words(const Json& json) {
  return text(json, "orbit") + " " + text(json, "links");
}

std::string tables_in_words(const Json& body) {
  std::string out = fmt::format("  {:<52}{:>22}{:>12}{:>12}\n", "orbits in use", "", "slots", "bytes");
  for (const Json& one : body["slots"])
    out +=
        fmt::format("    {:<72}{:>12}{:>12}\n", orbit_in_words(one), whole(one, "slots"), whole(one, "bytes"));
  out += fmt::format("  {:<40}{:<46}{:>12}\n", "embeddings", "on", "bytes");
  for (const Json& one : body["embeddings"])
    out += fmt::format("    {:<38}{:<46}{:>12}\n", text(one, "name"), orbit_in_words(one), whole(one, "bytes"));
  out += fmt::format("  {:<40}{:<34}{:>12}{:>12}\n", "interactions", "caused by", "rows", "bytes");
  for (const Json& one : body["interactions"]) {
    std::string label = text(one, "name");
    if (text(one, "rows_are") != "folded") label += fmt::format(" ({})", text(one, "rows_are"));
    out += fmt::format("    {:<38}{:<34}{:>12}{:>12}\n", label, orbit_in_words(one), whole(one, "rows"),
                       whole(one, "bytes"));
  }
  return out;
}

std::string body_in_words(const Json& body) {
  std::string out = fmt::format("body {}: a {}\n", text(body, "name"), text(body, "kind"));
  out += fmt::format("  {} vertices, {} edges, {} elements, {} darts, {} fragment{}, Euler characteristic {}\n",
                     whole(body, "vertices"), whole(body, "edges"), whole(body, "elements"),
                     whole(body, "darts"), whole(body, "fragments"), whole(body, "fragments") == 1 ? "" : "s",
                     body["euler"].get<long>());
  if (whole(body, "prescribed") > 0)
    out += fmt::format("  {} vertices are prescribed\n", whole(body, "prescribed"));
  out += tables_in_words(body);
  if (!body["laws"].empty()) out += fmt::format("  {:<86}{:>12}\n", "laws", "bytes");
  for (const Json& law : body["laws"])
    out += fmt::format("    {:<84}{:>12}\n",
                       fmt::format("{} above {:g} {}: {}", text(law, "criterion"), real(law, "threshold"),
                                   text(law, "unit"), text(law, "change")),
                       whole(law, "bytes"));
  for (const Json& one : body["left_out"]) out += folded("  left out  ", one.get<std::string>());
  for (const Json& one : body["notes"]) out += folded("  note      ", one.get<std::string>());
  if (body.contains("solver")) {
    const Json& solver = body["solver"];
    out += fmt::format("  solver    a matrix of {} blocks ({}), their places {}\n", whole(solver, "blocks"),
                       bytes_in_words(whole(solver, "matrix_bytes")),
                       bytes_in_words(whole(solver, "pattern_bytes")));
  }
  const Json& bytes = body["bytes"];
  return out + fmt::format("  bytes     map {}, embeddings {}, program {}\n",
                           bytes_in_words(whole(bytes, "map")), bytes_in_words(whole(bytes, "embeddings")),
                           bytes_in_words(whole(bytes, "program")));
}

} // namespace

Json inventory_of(const Session& session) {
  const Scene& scene = session.scene();
  Json inventory{{"preset", session.preset_path()}, {"name", scene.name()}};
  if (session.preset().has("thesis")) inventory["thesis"] = session.preset().text("thesis");
  inventory["time"] = time_json(session);
  inventory["bodies"] = Json::array();
  std::size_t map = 0, embeddings = 0, program = 0;
  for (const auto& body : scene.bodies()) {
    inventory["bodies"].push_back(body_json(*body));
    const Json& bytes = inventory["bodies"].back()["bytes"];
    map += whole(bytes, "map");
    embeddings += whole(bytes, "embeddings");
    program += whole(bytes, "program");
  }
  inventory["bytes"] = {{"map", map}, {"embeddings", embeddings}, {"program", program}};
  Json left_out = Json::array();
  if (!scene.world().floor) left_out.push_back("floor: none is drawn");
  if (scene.world().gravity.isZero(0)) left_out.push_back("gravity: none");
  inventory["left_out"] = std::move(left_out);
  return inventory;
}

std::string inventory_in_words(const Json& inventory) {
  std::string out = text(inventory, "name");
  if (inventory.contains("thesis")) out += fmt::format(" (thesis, {})", text(inventory, "thesis"));
  out += '\n';
  out += time_in_words(inventory["time"]);
  for (const Json& body : inventory["bodies"]) out += fmt::format("\n{}", body_in_words(body));
  out += "\n";
  for (const Json& one : inventory["left_out"]) out += folded("left out  ", one.get<std::string>());
  const Json& bytes = inventory["bytes"];
  const std::size_t sum = whole(bytes, "map") + whole(bytes, "embeddings") + whole(bytes, "program");
  return out + fmt::format("total     {} in all bodies\n", bytes_in_words(sum));
}

} // namespace rend
