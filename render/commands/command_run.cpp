// rend run: the simulation without pictures.
#include "render/clip/export_series.h"
#include "render/clip/figures.h"
#include "render/clip/fitted_camera.h"
#include "render/clip/named_files.h"
#include "render/clip/run_logs.h"
#include "render/clip/session.h"
#include "render/commands/command.h"
#include "render/console/console.h"
#include "render/console/json_text.h"
#include "render/console/number_option.h"
#include "render/console/progress.h"
#include "render/console/signals.h"
#include "render/facts/profile_report.h"
#include "render/help/usage.h"
#include "sim/base/profile.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>

namespace rend {
namespace {

struct RunOptions {
  SessionOptions session;
  bool json = false;
  std::string diagnostics, events;    // files; empty: none
  std::string format, folder, frames; // of the export; empty: not given
};

// Reports errors before anything slow is done.
void check_export(const RunOptions& options) {
  if (options.session.reach && !options.events.empty())
    throw UserError(Exit::Usage, {}, "--events lists tears, but nothing tears with --reach",
                    "leave out one of them");
  if (!options.format.empty()) {
    export_format(options.format);
    return;
  }
  if (!options.folder.empty() || !options.frames.empty())
    throw UserError(Exit::Usage, {}, "-o and --frames are for exported files, but there is no --export",
                    "add --export vtu (or ply, or obj), or make pictures with rend render");
}

NamedFiles files_of(const RunOptions& options) {
  NamedFiles files;
  files.reads("the preset", options.session.preset);
  if (!options.diagnostics.empty()) files.writes("--diagnostics", resolve_link(options.diagnostics));
  if (!options.events.empty()) files.writes("--events", resolve_link(options.events));
  return files;
}

std::unique_ptr<ExportSeries> export_of(const Session& session, const RunOptions& options) {
  if (options.format.empty()) return nullptr;
  const FrameChoice choice = options.frames.empty() ? FrameChoice() : FrameChoice(options.frames);
  last_chosen(choice, session.clock());
  return std::make_unique<ExportSeries>(session, export_format(options.format),
                                        folder_for(options.folder, session.scene().name()), choice);
}

Stopped simulate(Session& session, const RunOptions& options, ExportSeries* series) {
  std::optional<Diagnostics> diagnostics;
  std::optional<EventFile> events;
  if (!options.diagnostics.empty()) diagnostics.emplace(resolve_link(options.diagnostics));
  if (!options.events.empty()) events.emplace(resolve_link(options.events));
  Progress progress(session.quiet(), session.clock().steps(), session.clock().duration(), 0);
  Session::Callbacks calls;
  Profile* const profile = &session.scene().profile();
  calls.frame = [&](long frame) {
    const PhaseScope within(profile, Phase::Output);
    if (diagnostics) diagnostics->add(frame, session.scene());
    if (series) series->take(frame);
  };
  calls.step = [&] { progress.update(session.scene().steps_done(), session.scene().time(), 0); };
  profile->restart();
  const Stopped stopped = session.run(session.clock().frames() - 1, calls);
  const PhaseScope within(profile, Phase::Output);
  if (diagnostics && stopped == Stopped::Unstable)
    diagnostics->abandon();
  else if (diagnostics)
    diagnostics->finish();
  if (series) stopped == Stopped::Unstable ? series->abandon() : series->finish();
  if (events && (stopped != Stopped::Unstable || session.scene().tears() > 0)) events->write(session.scene());
  return stopped;
}

// Only answers whose time was reached count.
bool answers_hold(const Scene& scene) {
  for (const auto& body : scene.bodies())
    for (const Answer& answer : body->answers)
      if (answer.asked && !answer.holds()) return false;
  return true;
}

void print_figures(const RunOptions& options, const Figures& figures,
                   const std::optional<ProfileFigures>& profile) {
  if (!options.json) {
    print_result(summary_of(figures) + (profile ? profile_in_words(*profile) : ""));
    return;
  }
  nlohmann::ordered_json json = json_of(figures);
  if (profile) json["profile"] = json_of(*profile);
  print_result(text_of(json, 2) + "\n");
}

Exit run(const RunOptions& options) {
  const double start = wall_clock();
  check_export(options);
  NamedFiles files = files_of(options);
  SessionOptions wanted = options.session;
  wanted.count_fragments = !options.events.empty();
  Session session(wanted);
  files.reads_files(session.preset());
  const GracefulStop graceful_stop;
  // Files that are exported say where the camera stands.
  if (!options.format.empty() && fit_camera_to_clip(session) == Stopped::Interrupted)
    return exit_code_of(session, Stopped::Interrupted);
  const std::unique_ptr<ExportSeries> series = export_of(session, options);
  if (series) series->name_files(files);
  const Stopped stopped = simulate(session, options, series.get());
  Costs costs;
  costs.total = wall_clock() - start;
  Figures figures = figures_of(session, stopped, costs);
  if (series) figures.exported = series->figures();
  std::optional<ProfileFigures> profile;
  if (wanted.profile && session.scene().steps_done() > 0) profile = profile_of(session);
  print_figures(options, figures, profile);
  const Exit end = exit_code_of(session, stopped);
  return end == Exit::Done && !answers_hold(session.scene()) ? Exit::CheckFailed : end;
}

std::string export_formats_in_words() {
  std::string out;
  for (const ExportFormat& format : all_export_formats())
    out += fmt::format("{}{} ({})", out.empty() ? "" : "; ", format.name, format.what);
  return out;
}

std::function<Exit()> declare_run(const CommandLine& app) {
  auto options = std::make_shared<RunOptions>();
  add_run_options(app, options->session);
  app.add_flag("--json", options->json, "print the results as one JSON object on stdout");
  app.add_flag(
      "--reach", options->session.reach,
      "do not tear: print the largest value that each criterion of tearing reaches, when and where, to "
      "choose a threshold by");
  app.add_option(
         "--reach-every", options->session.reach_every,
         "with --reach: look at every Nth step; what is higher between two looks is missed; without it, at "
         "every 256th, in short runs more often")
      .type_name("N")
      .transform(whole_number(1, 1000000));
  app.add_flag("--profile", options->session.profile,
               "also print where the time and the memory traffic went, by stage and by interaction");
  app.add_option("--diagnostics", options->diagnostics,
                 "also write energies, momenta and counts at every frame to this file, as CSV")
      .type_name("FILE");
  app.add_option("--events", options->events, "also write every tear to this file, one JSON object a line")
      .type_name("FILE");
  app.add_option("--export", options->format,
                 "also write the state at every frame to a file for other programs: " +
                     export_formats_in_words())
      .type_name(choices(export_format_names()));
  app.add_option("-o,--output", options->folder, "folder for the exported files; default: out/SCENE")
      .type_name("DIR");
  app.add_option("--frames", options->frames,
                 "export only these frames, such as 7, 0-100, 0-100x2 (every second), 10- (to the end), or "
                 "several separated by commas")
      .type_name("LIST")
      .check(some_word());
  return [options] { return run(*options); };
}

} // namespace

Command run_command() {
  return {"run", "simulate a preset without pictures, and print its results", declare_run};
}

} // namespace rend
