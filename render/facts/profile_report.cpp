#include "render/facts/profile_report.h"

#include "render/console/json_or_null.h"
#include "render/facts/passes.h"
#include "sim/rows/row_times.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace rend {
namespace {

using Json = nlohmann::ordered_json;

Phase phase_of(PassStage stage) {
  switch (stage) {
  case PassStage::Forces:
  case PassStage::FurtherForces:
    break;
  case PassStage::Loads:
    return Phase::Loads;
  case PassStage::Laws:
    return Phase::Criteria;
  case PassStage::Solve:
  case PassStage::Integration:
    return Phase::Integration;
  case PassStage::Contact:
    return Phase::Contact;
  }
  return Phase::Forces;
}

// [bytes] per step, by stage.
std::array<double, phase_count> bytes_by_stage(const Scene& scene) {
  std::array<double, phase_count> bytes{};
  for (const Pass& pass : passes_of(scene))
    bytes[static_cast<std::size_t>(phase_of(pass.stage))] += pass.times * static_cast<double>(pass.bytes);
  return bytes;
}

std::optional<double> share_of(double part, double whole) {
  return whole > 0 ? std::optional(part / whole) : std::nullopt;
}

std::vector<StageFigures> stages_of(const Scene& scene, const MachineSpeed& machine) {
  const Profile& profile = scene.profile();
  const std::array<double, phase_count> bytes = bytes_by_stage(scene);
  const auto steps = static_cast<double>(scene.steps_done());
  std::vector<StageFigures> all;
  for (std::size_t n = 0; n < phase_count; ++n) {
    StageFigures one;
    one.stage = static_cast<Phase>(n);
    one.spent = profile.spent(one.stage);
    if (one.spent.turns == 0) continue;
    one.share = share_of(one.spent.seconds, profile.total());
    one.seconds_per_step = share_of(one.spent.seconds, steps);
    one.bytes_per_step = bytes[n];
    if (bytes[n] > 0) one.bandwidth_share = share_of(bytes[n] * steps, one.spent.seconds * machine.bytes);
    all.push_back(one);
  }
  return all;
}

// Threads work at once: seconds of all of them are `parts` times those on the clock.
InteractionFigures interaction_of(const Body& body, const Binder& binder, const RowTimes& times,
                                  std::size_t number, RowsAre rows_are, const MachineSpeed& machine) {
  const bool corners = rows_are == RowsAre::Cornered;
  const RowCost cost = cost_of(binder, corners);
  const auto rows = static_cast<double>(binder.rows().live_count());
  const double seconds = times.seconds(number), run = rows * static_cast<double>(times.evaluations());
  const double parts = corners ? 1 : body.program->parts();
  const double on_clock = seconds / parts * machine.threads; // were all threads at work
  InteractionFigures one;
  one.body = body.name;
  one.name = binder.interaction()->name;
  one.rows_are = rows_are;
  one.rows = binder.rows().live_count();
  one.evaluations = times.evaluations();
  one.seconds = seconds;
  if (run > 0) one.ns_per_row = 1e9 * seconds / run;
  one.cost = cost;
  one.bandwidth_share = share_of(run * (cost.read + cost.written), on_clock * machine.bytes);
  if (cost.operations) one.peak_share = share_of(run * *cost.operations, on_clock * machine.operations);
  return one;
}

std::vector<InteractionFigures> interactions_of(const Scene& scene, const MachineSpeed& machine) {
  std::vector<InteractionFigures> all;
  const auto add = [&](const Body& body, const std::vector<Binder>& binders, const RowTimes* times,
                       RowsAre rows_are) {
    if (!times || times->evaluations() == 0) return;
    for (std::size_t n = 0; n < binders.size(); ++n)
      all.push_back(interaction_of(body, binders[n], *times, n, rows_are, machine));
  };
  for (const auto& body : scene.bodies()) {
    const Program& program = *body->program;
    add(*body, program.folded(), program.folded_times(), folded_rows_are(program));
    add(*body, program.elementary(), program.elementary_times(), RowsAre::Cornered);
  }
  return all;
}

Json json_of(const StageFigures& s) {
  Json one{{"stage", name_of(s.stage)},
           {"seconds", s.spent.seconds},
           {"share", json_or_null(s.share)},
           {"turns", s.spent.turns},
           {"seconds_per_step", json_or_null(s.seconds_per_step)}};
  if (s.bytes_per_step > 0) {
    one["bytes_per_step"] = s.bytes_per_step;
    one["bandwidth_share"] = json_or_null(s.bandwidth_share);
  }
  return one;
}

Json json_of(const InteractionFigures& i) {
  return {{"body", i.body},
          {"name", i.name},
          {"rows_are", name_of(i.rows_are)},
          {"rows", i.rows},
          {"evaluations", i.evaluations},
          {"seconds", i.seconds},
          {"ns_per_row", json_or_null(i.ns_per_row)},
          {"read_per_row", i.cost.read},
          {"written_per_row", i.cost.written},
          {"operations_per_row", json_or_null(i.cost.operations)},
          {"bandwidth_share", json_or_null(i.bandwidth_share)},
          {"peak_share", json_or_null(i.peak_share)}};
}

std::string number_or_dash(const std::optional<double>& value, const char* format, double factor = 1) {
  return value ? fmt::format(fmt::runtime(format), factor * *value) : "-";
}

std::string stages_in_words(const std::vector<StageFigures>& stages) {
  std::string out =
      "  stage             seconds   share      µs a step      bytes a step    of the memory's bandwidth\n";
  for (const StageFigures& s : stages)
    out += fmt::format("  {:<15} {:>9.4f} {:>6.1f}% {:>14} {:>17} {:>15}\n", name_of(s.stage), s.spent.seconds,
                       100 * s.share.value_or(0), number_or_dash(s.seconds_per_step, "{:.3f}", 1e6),
                       s.bytes_per_step > 0 ? fmt::format("{:.0f}", s.bytes_per_step) : "-",
                       number_or_dash(s.bandwidth_share, "{:.0f}%", 100));
  return out;
}

std::string interactions_in_words(const std::vector<InteractionFigures>& interactions) {
  std::string out =
      "  interaction                rows  ns a row   bytes a row       operations        share of\n"
      "                                             read  written      a row    bandwidth   peak\n";
  for (const InteractionFigures& i : interactions)
    out += fmt::format("  {:<20} {:>10} {:>9} {:>7.0f} {:>8.0f} {:>10} {:>12} {:>6}\n", i.name, i.rows,
                       number_or_dash(i.ns_per_row, "{:.2f}"), i.cost.read, i.cost.written,
                       number_or_dash(i.cost.operations, "{:.0f}"),
                       number_or_dash(i.bandwidth_share, "{:.0f}%", 100),
                       number_or_dash(i.peak_share, "{:.0f}%", 100));
  return out;
}

} // namespace

ProfileFigures profile_of(const Session& session) {
  const Scene& scene = session.scene();
  int threads = 1;
  for (const auto& body : scene.bodies()) threads = std::max(threads, body->program->parts());
  const Profile& profile = scene.profile();
  const SceneSeconds before = scene.seconds();
  ProfileFigures figures;
  figures.machine = measure_machine(threads);
  for (std::size_t n = 0; n < phase_count; ++n) figures.readings += profile.spent(static_cast<Phase>(n)).turns;
  figures.seconds_each = profile.reading();
  figures.build = before.build;
  figures.bind = before.bind;
  figures.seconds = profile.total();
  figures.stages = stages_of(scene, figures.machine);
  figures.interactions = interactions_of(scene, figures.machine);
  figures.width = name_of(simd_width());
  return figures;
}

Json json_of(const ProfileFigures& profile) {
  Json stages = Json::array(), interactions = Json::array();
  for (const StageFigures& one : profile.stages) stages.push_back(json_of(one));
  for (const InteractionFigures& one : profile.interactions) interactions.push_back(json_of(one));
  return {{"before", {{"build", profile.build}, {"bind", profile.bind}}},
          {"seconds", profile.seconds},
          {"stages", std::move(stages)},
          {"interactions", std::move(interactions)},
          {"machine",
           {{"threads", profile.machine.threads},
            {"width", profile.width},
            {"bytes_per_second", profile.machine.bytes},
            {"operations_per_second", profile.machine.operations}}},
          {"clock", {{"readings", profile.readings}, {"seconds_each", profile.seconds_each}}}};
}

std::string profile_in_words(const ProfileFigures& profile) {
  const MachineSpeed& machine = profile.machine;
  std::string out =
      fmt::format("  profile    {:.4f} s of the time loop, after {:.4f} s to build and {:.4f} s to bind\n",
                  profile.seconds, profile.build, profile.bind);
  out += stages_in_words(profile.stages);
  if (!profile.interactions.empty()) out += interactions_in_words(profile.interactions);
  out += fmt::format("  machine    {:.1f} GB/s to and from memory, {:.1f} G operations/s ({}, {} thread{}), "
                     "as just measured\n",
                     1e-9 * machine.bytes, 1e-9 * machine.operations, profile.width, machine.threads,
                     machine.threads == 1 ? "" : "s");
  out += fmt::format("  clock      read {} times, of {:.0f} ns each, which are taken off\n", profile.readings,
                     1e9 * profile.seconds_each);
  return out;
}

} // namespace rend
