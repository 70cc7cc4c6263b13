#include "render/facts/profile_report.h"

#include "render/facts/machine_speed.h"
#include "render/facts/passes.h"
#include "sim/base/profile.h"
#include "sim/rows/row_cost.h"
#include "sim/rows/row_times.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

using Json = nlohmann::ordered_json;

// The stage that a pass of a step belongs to.
Phase stage_of(const std::string& pass) {
  if (pass == "loads") return Phase::Loads;
  if (pass == "laws") return Phase::Criteria;
  if (pass == "contact") return Phase::Contact;
  if (pass == "integration" || pass == "solve") return Phase::Integration;
  return Phase::Forces;
}

// [byte] a step, by stage.
std::array<double, phase_count> bytes_by_stage(const Scene& scene) {
  std::array<double, phase_count> bytes{};
  for (const Json& pass : passes_of(scene))
    bytes[static_cast<std::size_t>(stage_of(pass["stage"].get<std::string>()))] +=
        pass["times"].get<double>() * pass["bytes"].get<double>();
  return bytes;
}

Json share_or_null(double part, double whole) {
  return whole > 0 ? Json(part / whole) : Json(nullptr);
}

Json stages_json(const Scene& scene, const MachineSpeed& machine) {
  const Profile& profile = scene.profile();
  const std::array<double, phase_count> bytes = bytes_by_stage(scene);
  const auto steps = static_cast<double>(scene.steps_done());
  Json all = Json::array();
  for (std::size_t n = 0; n < phase_count; ++n) {
    const Profile::Spent spent = profile.spent(static_cast<Phase>(n));
    if (spent.turns == 0) continue;
    Json one{{"stage", name_of(static_cast<Phase>(n))},
             {"seconds", spent.seconds},
             {"share", share_or_null(spent.seconds, profile.total())},
             {"turns", spent.turns},
             {"seconds_per_step", share_or_null(spent.seconds, steps)}};
    if (bytes[n] > 0) {
      one["bytes_per_step"] = bytes[n];
      one["bandwidth_share"] = share_or_null(bytes[n] * steps, spent.seconds * machine.bytes);
    }
    all.push_back(std::move(one));
  }
  return all;
}

// Threads work at once: seconds of all of them are `parts` times those on the clock.
Json interaction_json(const Body& body, const Binder& binder, const RowTimes& times, std::size_t number,
                      bool corners, const MachineSpeed& machine) {
  const RowCost cost = cost_of(binder, corners);
  const auto rows = static_cast<double>(binder.rows().live_count());
  const double seconds = times.seconds(number), run = rows * static_cast<double>(times.evaluations());
  const double parts = corners ? 1 : body.program->parts();
  const double on_clock = seconds / parts * machine.threads; // were all threads at work
  Json one{{"body", body.name},
           {"name", binder.interaction()->name},
           {"rows_are", corners ? "each by itself, into corners"
                                : (body.program->options().fold ? "folded" : "each by itself")},
           {"rows", binder.rows().live_count()},
           {"evaluations", times.evaluations()},
           {"seconds", seconds},
           {"ns_per_row", run > 0 ? Json(1e9 * seconds / run) : Json(nullptr)},
           {"read_per_row", cost.read},
           {"written_per_row", cost.written},
           {"operations_per_row", cost.operations ? Json(*cost.operations) : Json(nullptr)}};
  one["bandwidth_share"] = share_or_null(run * (cost.read + cost.written), on_clock * machine.bytes);
  one["peak_share"] =
      cost.operations ? share_or_null(run * *cost.operations, on_clock * machine.operations) : Json(nullptr);
  return one;
}

Json interactions_json(const Scene& scene, const MachineSpeed& machine) {
  Json all = Json::array();
  const auto add = [&](const Body& body, const std::vector<Binder>& binders, const RowTimes* times,
                       bool corners) {
    if (!times || times->evaluations() == 0) return;
    for (std::size_t n = 0; n < binders.size(); ++n)
      all.push_back(interaction_json(body, binders[n], *times, n, corners, machine));
  };
  for (const auto& body : scene.bodies()) {
    const Program& program = *body->program;
    add(*body, program.folded(), program.folded_times(), false);
    add(*body, program.elementary(), program.elementary_times(), true);
  }
  return all;
}

std::string number_or_dash(const Json& value, const char* format, double factor = 1) {
  return value.is_null() ? "-" : fmt::format(fmt::runtime(format), factor * value.get<double>());
}

std::string stages_in_words(const Json& stages) {
  std::string out =
      "  stage             seconds   share      µs a step      bytes a step    of the memory's bandwidth\n";
  for (const Json& s : stages)
    out += fmt::format("  {:<15} {:>9.4f} {:>6.1f}% {:>14} {:>17} {:>15}\n", s["stage"].get<std::string>(),
                       s["seconds"].get<double>(), s["share"].is_null() ? 0 : 100 * s["share"].get<double>(),
                       number_or_dash(s["seconds_per_step"], "{:.3f}", 1e6),
                       number_or_dash(s.value("bytes_per_step", Json()), "{:.0f}"),
                       number_or_dash(s.value("bandwidth_share", Json()), "{:.0f}%", 100));
  return out;
}

std::string interactions_in_words(const Json& interactions) {
  std::string out =
      "  interaction                rows  ns a row   bytes a row       operations        share of\n"
      "                                             read  written      a row    bandwidth   peak\n";
  for (const Json& i : interactions)
    out += fmt::format("  {:<20} {:>10} {:>9} {:>7.0f} {:>8.0f} {:>10} {:>12} {:>6}\n",
                       i["name"].get<std::string>(), i["rows"].get<std::size_t>(),
                       number_or_dash(i["ns_per_row"], "{:.2f}"), i["read_per_row"].get<double>(),
                       i["written_per_row"].get<double>(), number_or_dash(i["operations_per_row"], "{:.0f}"),
                       number_or_dash(i["bandwidth_share"], "{:.0f}%", 100),
                       number_or_dash(i["peak_share"], "{:.0f}%", 100));
  return out;
}

} // namespace

Json profile_json(const Session& session) {
  const Scene& scene = session.scene();
  int threads = 1;
  for (const auto& body : scene.bodies()) threads = std::max(threads, body->program->parts());
  const MachineSpeed machine = measure_machine(threads);
  const Profile& profile = scene.profile();
  long turns = 0;
  for (std::size_t n = 0; n < phase_count; ++n) turns += profile.spent(static_cast<Phase>(n)).turns;
  const SceneSeconds before = scene.seconds();
  return {{"before", {{"build", before.build}, {"bind", before.bind}}}, // [s]
          {"seconds", profile.total()},
          {"stages", stages_json(scene, machine)},
          {"interactions", interactions_json(scene, machine)},
          {"machine",
           {{"threads", machine.threads},
            {"width", name_of(simd_width())},
            {"bytes_per_second", machine.bytes},
            {"operations_per_second", machine.operations}}},
          {"clock", {{"readings", turns}, {"seconds_each", profile.reading()}}}};
}

std::string profile_in_words(const Json& profile) {
  const Json &machine = profile["machine"], &clock = profile["clock"];
  std::string out =
      fmt::format("  profile    {:.4f} s of the time loop, after {:.4f} s to build and {:.4f} s to bind\n",
                  profile["seconds"].get<double>(), profile["before"]["build"].get<double>(),
                  profile["before"]["bind"].get<double>());
  out += stages_in_words(profile["stages"]);
  if (!profile["interactions"].empty()) out += interactions_in_words(profile["interactions"]);
  const int threads = machine["threads"].get<int>();
  out += fmt::format("  machine    {:.1f} GB/s to and from memory, {:.1f} G operations/s ({}, {} thread{}), "
                     "as just measured\n",
                     1e-9 * machine["bytes_per_second"].get<double>(),
                     1e-9 * machine["operations_per_second"].get<double>(), machine["width"].get<std::string>(),
                     threads, threads == 1 ? "" : "s");
  out += fmt::format("  clock      read {} times, of {:.0f} ns each, which are taken off\n",
                     clock["readings"].get<long>(), 1e9 * clock["seconds_each"].get<double>());
  return out;
}

} // namespace rend
