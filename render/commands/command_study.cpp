// rend study: error against run time.
#include "render/clip/named_files.h"
#include "render/clip/session.h"
#include "render/commands/command.h"
#include "render/console/console.h"
#include "render/console/json_text.h"
#include "render/console/signals.h"
#include "render/files/output.h"
#include "render/pages/lean_report.h"
#include "render/pages/study_page.h"
#include "render/pages/study_plots.h"
#include "render/pages/study_table.h"
#include "render/picture/scene_preset.h"
#include "render/studies/study_options.h"
#include "sim/base/printable.h"
#include "sim/preset/paths.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <iterator>
#include <memory>

namespace rend {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> presets_of(const StudyOptions& options) {
  std::vector<std::string> presets = options.further;
  if (!options.session.preset.empty()) presets.insert(presets.begin(), options.session.preset);
  return presets;
}

// Before anything runs, so that a folder that is not writable is reported at once. `kind`: the base name of its
// tables.
fs::path make_folder(const StudyOptions& options, const std::string& name, const std::string& kind) {
  const fs::path folder =
      options.folder.empty() ? fs::path("out") / (name + "-study") : fs::path(options.folder);
  NamedFiles files;
  for (const std::string& preset : presets_of(options)) files.reads("the preset", preset);
  for (const std::string& file : {kind + ".csv", kind + ".json", std::string("index.html")})
    files.writes("the study", folder / file);
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder))
    throw UserError(Exit::CannotCreate, {folder.string()},
                    "the folder cannot be created" + (error ? ": " + error.message() : std::string{}),
                    "choose another one with -o");
  OutputFile probe(folder / (kind + ".csv")); // tests whether it is writable; removed without commit()
  return folder;
}

// Progress: a line that is overwritten on a terminal; elsewhere one every few seconds.
class ProgressLine {
public:
  explicit ProgressLine(bool quiet) : quiet_(quiet), terminal_(is_terminal(stderr)) {}
  ~ProgressLine() { clear(); }
  void tell(const std::string& what, double share) {
    const double now = wall_clock();
    if (quiet_ || now < next_) return;
    next_ = now + (terminal_ ? 0.1 : 5);
    print_progress(fmt::format("{}{:3.0f}%  {}{}", terminal_ ? "\r" : "", 100 * share, printable(what),
                               terminal_ ? "\033[K" : "\n"));
    shown_ = terminal_;
  }
  void clear() {
    if (shown_) print_progress("\r\033[K");
    shown_ = false;
  }

private:
  bool quiet_, terminal_, shown_ = false;
  double next_ = 0; // [s]
};

std::vector<DrawnPlot> write_plots(const StudyReport& report, const std::string& name, const fs::path& folder) {
  std::vector<DrawnPlot> drawn;
  for (const NamedPlot& plot : plots_of(report, name)) {
    const auto svg = draw(plot.plot, PlotFormat::Svg);
    if (!svg) {
      print_note("gnuplot is not installed (Debian: gnuplot-nox): the page has its tables, but no plots");
      return {};
    }
    write_atomically(folder / (plot.file + ".svg"), *svg);
    write_atomically(folder / (plot.file + ".png"), *draw(plot.plot, PlotFormat::Png));
    drawn.push_back({*svg, plot.caption});
  }
  return drawn;
}

Exit stopped(ProgressLine& progress_line) {
  progress_line.clear();
  print_error("the study was stopped by a signal: nothing was written");
  return exit_code_of_signal();
}

// The text of the preset's file.
std::string content_of(const fs::path& path, bool allow_path) {
  const auto scene = load_scene(path, {}); // reports errors in it
  if (!allow_path) check_paths(*scene);
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

LeanPlan lean_plan(const StudyOptions& options) {
  LeanPlan plan;
  for (const std::string& set : options.session.sets) plan.overrides.push_back(parse_override(set));
  if (options.quick) {
    plan.builds = 5;
    plan.pairs = 2;
    plan.seconds = 2e-3;
  }
  const std::vector<std::string> presets = presets_of(options);
  for (const std::string& preset : presets)
    plan.scenes.push_back({fs::path(preset).stem(), content_of(preset, options.session.allow_path), preset});
  if (presets.empty()) plan.scenes = lean_scenes();
  return plan;
}

Exit lean(const StudyOptions& options) {
  const LeanPlan plan = lean_plan(options);
  const GracefulStop graceful_stop;
  const fs::path folder = make_folder(options, "lean", "lean");
  ProgressLine progress_line(options.session.quiet);
  const StudyCalls calls{[&](const std::string& what, double share) { progress_line.tell(what, share); },
                         [] { return stop_signal() == 0; }};
  std::vector<LeanRow> rows;
  try {
    rows = run_lean(plan, calls);
  } catch (const StopRequested&) {
    return stopped(progress_line);
  }
  progress_line.clear();
  const Provenance provenance = provenance_of_build();
  const nlohmann::ordered_json json{{"rows", json_of(rows)}, {"provenance", json_of(provenance)}};
  write_atomically(folder / "lean.csv", csv_of(rows));
  write_atomically(folder / "lean.json", text_of(json, 2) + "\n");
  write_atomically(folder / "index.html", page_of(rows, provenance));
  sync_folder(folder);
  print_result(options.json ? text_of(json, 2) + "\n"
                            : table_of(rows) +
                                  fmt::format("The page is {}\n", printable((folder / "index.html").string())));
  const bool kept = std::all_of(rows.begin(), rows.end(), [](const LeanRow& row) { return row.as_required(); });
  return kept ? Exit::Done : Exit::CheckFailed;
}

// Refuses options that exclude each other.
void check_options(const StudyOptions& options) {
  if (!options.lean && options.session.preset.empty())
    throw UserError(Exit::Usage, {}, "a preset is missing", "name one: rend study PRESET");
  if (!options.lean && !options.further.empty())
    throw UserError(Exit::Usage, {}, "one preset is studied at a time", "several can be given with --lean");
}

Exit study(const StudyOptions& options) {
  check_options(options);
  if (options.lean) return lean(options);
  const StudyTask task = study_task(options);
  const GracefulStop graceful_stop;
  const fs::path folder = make_folder(options, task.name, "study");
  ProgressLine progress_line(options.session.quiet);
  StudyCalls calls;
  calls.progress = [&](const std::string& what, double share) { progress_line.tell(what, share); };
  calls.going = [] { return stop_signal() == 0; };
  StudyReport report;
  try {
    report = run_study(task.plan, task.make, calls);
  } catch (const StopRequested&) {
    return stopped(progress_line);
  }
  progress_line.clear();
  const Provenance provenance = provenance_of(options.session.preset, task.text);
  nlohmann::ordered_json json = json_of(report);
  json["name"] = task.name;
  json["findings"] = findings_of(report);
  json["provenance"] = json_of(provenance);
  write_atomically(folder / "study.csv", csv_of(report));
  write_atomically(folder / "study.json", text_of(json, 2) + "\n");
  write_atomically(folder / "index.html",
                   page_of(report, task.name, write_plots(report, task.name, folder), provenance));
  sync_folder(folder);
  if (options.json) {
    print_result(text_of(json, 2) + "\n");
  } else {
    std::string out = fmt::format("{}: {} runs, each of {:.4g} s of simulated time\n", printable(task.name),
                                  report.rows.size(), report.duration);
    for (const std::string& line : findings_of(report)) out += "  " + printable(line) + "\n";
    print_result(out + fmt::format("  The page is {}\n", printable((folder / "index.html").string())));
  }
  return Exit::Done;
}

std::function<Exit()> declare_study(const CommandLine& app) {
  auto options = std::make_shared<StudyOptions>();
  declare_study(app, *options);
  return [options] { return study(*options); };
}

} // namespace

Command study_command() {
  return {"study", "measure the error of each time scheme against its run time", declare_study};
}

} // namespace rend
