// rend check: numerical stability on stiff and extreme cases.
#include "render/clip/named_files.h"
#include "render/clip/session.h"
#include "render/commands/command.h"
#include "render/console/console.h"
#include "render/console/json_text.h"
#include "render/console/number_option.h"
#include "render/console/signals.h"
#include "render/files/output.h"
#include "render/files/work_folder.h"
#include "render/pages/check_report.h"
#include "render/picture/scene_preset.h"
#include "render/studies/check_run.h"
#include "sim/base/printable.h"
#include "sim/base/threads.h"
#include "sim/base/wording.h"
#include "sim/check/preset_check.h"
#include "sim/preset/paths.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <fnmatch.h>
#include <memory>
#include <optional>

namespace rend {
namespace {

namespace fs = std::filesystem;

struct CheckOptions {
  std::vector<std::string> presets; // empty: the suite
  std::string folder;               // empty: no files are written
  std::vector<std::string> only;    // patterns of names
  bool list = false, json = false, quick = false, quiet = false, allow_path = false;
  int jobs = 0; // 0: as many as the machine has threads
};

// Part of a name is enough: "static" means "*static*".
bool is_wanted(const CheckCase& which, const CheckOptions& options) {
  if (options.quick && options.presets.empty() && !which.quick) return false;
  return options.only.empty() ||
         std::any_of(options.only.begin(), options.only.end(), [&](const std::string& pattern) {
           return fnmatch(("*" + pattern + "*").c_str(), which.name.c_str(), 0) == 0;
         });
}

CheckChapter chapter_of(const std::string& preset, const CheckOptions& options) {
  const fs::path path(preset);
  CheckFamily family{path.stem().string(), preset,
                     "Whether the preset is stable as it is, with which margin, at which step it breaks, and "
                     "which scheme would work.",
                     nullptr};
  CheckChapter chapter{family, {}, {}};
  for (CheckCase& one : preset_cases(family.name, preset))
    if (is_wanted(one, options)) chapter.cases.push_back(std::move(one));
  return chapter;
}

CheckChapter chapter_of(const CheckFamily& family, const CheckOptions& options) {
  CheckChapter chapter{family, {}, {}};
  for (CheckCase& one : family.cases())
    if (is_wanted(one, options)) chapter.cases.push_back(std::move(one));
  return chapter;
}

// Each case reads the preset again; a pipe would give nothing the second time, or block for ever.
void refuse_pipe(const fs::path& preset) {
  std::error_code error;
  const fs::file_status there = fs::status(preset, error);
  if (!fs::exists(there) || fs::is_regular_file(there) || fs::is_directory(there)) return;
  throw UserError(Exit::NoInput, {preset.string()},
                  "this is not a regular file, but it must be read once for each case", "copy it to a file");
}

// No case is left.
[[noreturn]] void refuse_names(const CheckOptions& options) {
  std::vector<std::string> patterns, names;
  for (const std::string& pattern : options.only) patterns.push_back(in_quotes(pattern));
  for (const CheckFamily& family : all_families()) names.push_back(family.name);
  const std::string groups =
      options.presets.empty() ? "the groups of cases are " + listed(names) + "; " : std::string();
  const bool few = options.quick && options.presets.empty();
  throw UserError(
      Exit::Usage, {},
      fmt::format("--only: the name of no case{} has {} in it", few ? " of --quick" : "", listed(patterns)),
      groups + "--list names all");
}

std::vector<CheckChapter> wanted(const CheckOptions& options) {
  std::vector<CheckChapter> chapters;
  const auto add = [&](CheckChapter chapter) {
    if (!chapter.cases.empty()) chapters.push_back(std::move(chapter));
  };
  for (const std::string& preset : options.presets) {
    refuse_pipe(preset);
    const auto scene = load_scene(preset); // reports a bad preset before anything slow
    if (!options.allow_path) check_paths(*scene);
    add(chapter_of(preset, options));
  }
  if (options.presets.empty())
    for (const CheckFamily& family : all_families()) add(chapter_of(family, options));
  if (chapters.empty()) refuse_names(options);
  return chapters;
}

// No input may be overwritten.
void check_files(const CheckOptions& options) {
  if (options.folder.empty()) return;
  NamedFiles files;
  for (const std::string& preset : options.presets) files.reads("the preset", preset);
  for (const char* file : {"check.json", "index.html"})
    files.writes("the report", fs::path(options.folder) / file);
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error)
    throw UserError(Exit::CannotCreate, {path.string(), 0, 0}, "the folder cannot be made: " + error.message());
}

std::string line_of(std::size_t number, std::size_t all, const CheckCase& which, const CheckResult& result) {
  const Finding& f = result.finding;
  std::string line = fmt::format("[{:>4}/{}] {:<11} {:7.2f} s  {}", number, all, name_of(f.verdict),
                                 result.seconds, printable(which.name));
  if (f.verdict == Verdict::Failed) {
    line += fmt::format("\n             expected: {}\n             {}", which.expectation, printable(f.what));
    for (const Measure& m : f.measures)
      if (!m.holds())
        line += fmt::format("\n             {}: {:.6g}, not within {:.6g} and {:.6g}", m.what, m.got, m.low,
                            m.high);
  }
  return line + "\n";
}

// Runs the cases of all chapters as one list, so that no thread idles at the end of a family.
void run_all(std::vector<CheckChapter>& chapters, const fs::path& folder, const CheckOptions& options) {
  std::vector<CheckCase> cases;
  for (const CheckChapter& chapter : chapters)
    cases.insert(cases.end(), chapter.cases.begin(), chapter.cases.end());
  write_cases(folder, cases);
  std::size_t count = 0;
  const auto say = [&](std::size_t n, const CheckResult& result) {
    ++count;
    if (!options.quiet) print_progress(line_of(count, cases.size(), cases[n], result));
  };
  const int jobs = options.jobs > 0 ? options.jobs : hardware_threads();
  const auto fewer = [&] {
    if (!options.quiet) note_fewer_threads();
  };
  std::vector<CheckResult> results = run_cases(folder, cases, jobs, say, fewer);
  if (results.size() < cases.size()) return; // interrupted by a signal
  auto next = results.begin();
  for (CheckChapter& chapter : chapters)
    for (std::size_t n = 0; n < chapter.cases.size(); ++n) chapter.results.push_back(std::move(*next++));
}

std::string summary_of(const std::vector<CheckChapter>& chapters, double seconds, const std::string& folder) {
  const CheckCounts counts = count(chapters);
  std::string out =
      fmt::format("{} case{} in {}: {} ok, {} refused as expected, {} at a known limit, {} failed\n",
                  counts.all(), counts.all() == 1 ? "" : "s", seconds_in_words(seconds), counts.ok,
                  counts.refused, counts.limits, counts.failed);
  for (const CheckChapter& chapter : chapters)
    for (std::size_t n = 0; n < chapter.results.size(); ++n)
      if (chapter.results[n].finding.verdict == Verdict::Failed)
        out += fmt::format("  failed: {}: {}\n", printable(chapter.cases[n].name),
                           printable(chapter.results[n].finding.what));
  if (!folder.empty()) out += fmt::format("  {}\n", printable((fs::path(folder) / "index.html").string()));
  return out;
}

Exit check(const CheckOptions& options) {
  std::vector<CheckChapter> chapters = wanted(options);
  if (options.list) {
    std::string names;
    for (const CheckChapter& chapter : chapters)
      for (const CheckCase& one : chapter.cases) names += printable(one.name) + "\n";
    print_result(names);
    return Exit::Done;
  }
  check_files(options);
  const double start = wall_clock();
  const GracefulStop graceful_stop;
  std::optional<WorkFolder> temporary; // for the cases' presets when no output folder was given
  if (options.folder.empty()) temporary.emplace("rend-check", "give one with -o");
  const fs::path cases = temporary ? temporary->path() : fs::path(options.folder) / "cases";
  make_folder(cases);
  run_all(chapters, cases, options);
  if (chapters.front().results.empty()) {
    print_error("stopped by a signal: no report was written");
    return exit_code_of_signal();
  }
  const double seconds = wall_clock() - start;
  const nlohmann::ordered_json json = check_json(chapters, seconds);
  if (!options.folder.empty()) {
    write_atomically(fs::path(options.folder) / "check.json", text_of(json, 2) + "\n");
    write_atomically(fs::path(options.folder) / "index.html", check_page(chapters, seconds));
    sync_folder(options.folder);
  }
  print_result(options.json ? text_of(json, 2) + "\n" : summary_of(chapters, seconds, options.folder));
  return count(chapters).failed > 0 ? Exit::CheckFailed : Exit::Done;
}

std::function<Exit()> declare_check(const CommandLine& app) {
  auto options = std::make_shared<CheckOptions>();
  app.add_option("presets", options->presets, "presets to check; without any, the built-in cases")
      .type_name("PRESET...");
  app.add_option("-o,--output", options->folder,
                 "folder for index.html, check.json and the presets of all cases; default: none is written")
      .type_name("DIR");
  app.add_option("--only", options->only, "run only cases whose name contains this (* and ? are wildcards)")
      .type_name("PATTERN")
      .allow_extra_args(false);
  app.add_flag("--allow-path", options->allow_path,
               "allow presets to name meshes, rules and pictures outside of their folders");
  app.add_flag("--quick", options->quick, "run only a few representative cases");
  app.add_flag("--list", options->list, "print the names of the cases, one a line, and run none");
  app.add_flag("--json", options->json, "print the results as one JSON object on stdout");
  app.add_option("--jobs", options->jobs,
                 "run at most N cases at once; default: the number of the machine's threads")
      .type_name("N")
      .transform(whole_number(1, 256));
  app.add_flag("-q,--quiet", options->quiet, "do not print a line for each case");
  return [options] { return check(*options); };
}

} // namespace

Command check_command() {
  return {"check", "check numerical stability on stiff and extreme cases", declare_check};
}

} // namespace rend
