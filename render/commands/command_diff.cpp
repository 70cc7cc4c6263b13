// rend diff: compares pictures, or folders of pictures.
#include "render/batch/available_memory.h"
#include "render/clip/named_files.h"
#include "render/commands/command.h"
#include "render/compare/tolerances.h"
#include "render/compare/update.h"
#include "render/console/console.h"
#include "render/console/number_option.h"
#include "render/console/signals.h"
#include "render/files/output.h"
#include "render/files/png.h"
#include "render/help/usage.h"
#include "render/pages/diff_page.h"
#include "render/pages/diff_report.h"
#include "sim/base/printable.h"
#include "sim/base/start_threads.h"
#include "sim/base/stop_request.h"
#include "sim/base/threads.h"
#include "sim/base/worker_threads.h"
#include "sim/preset/paths.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>

namespace rend {
namespace {

namespace fs = std::filesystem;

struct DiffOptions {
  std::string a, b, folder, junit, gitlab, github, tolerances, mask;
  std::vector<std::string> limits, update;
  bool allow_path = false, json = false, json_lines = false, quiet = false;
  int threads = 0; // 0: as many as the machine has
};

Tolerances tolerances_of(const DiffOptions& options) {
  Tolerances out =
      options.tolerances.empty() ? Tolerances() : Tolerances(options.tolerances, options.allow_path);
  for (const std::string& limit : options.limits) out.add(limit);
  std::error_code error;
  if (!options.mask.empty() && !fs::exists(options.mask, error))
    throw UserError(Exit::NoInput, {options.mask}, "there is no such file", "--mask takes a PNG file");
  if (!options.mask.empty()) out.mask_all(options.mask);
  return out;
}

// Prints each case as soon as all cases before it are done, so that the order of lines does not depend on
// threads.
class OrderedPrinter {
public:
  OrderedPrinter(std::vector<std::optional<CaseResult>>& results, bool json_lines)
      : results_(results), say_(json_lines) {}
  void put(std::size_t n, CaseResult&& one) {
    const std::lock_guard lock(mutex_);
    results_[n] = std::move(one);
    for (; next_ < results_.size() && results_[next_]; ++next_)
      if (say_) print_result(text_of(case_json(*results_[next_], Expectation::Kept)) + "\n");
  }

private:
  std::vector<std::optional<CaseResult>>& results_;
  bool say_;
  std::size_t next_ = 0;
  std::mutex mutex_;
};

// With few cases, one after another on all threads; with many, in parallel. Empty after a signal.
std::vector<CaseResult> compare_all(const std::vector<CasePaths>& cases, const Tolerances& tolerances,
                                    const DiffOptions& options, MemoryBudget& memory) {
  const int threads = options.threads > 0 ? options.threads : hardware_threads();
  const int jobs = cases.size() >= 2 * static_cast<std::size_t>(threads) ? std::min(threads, 8) : 1;
  std::vector<std::optional<CaseResult>> results(cases.size());
  OrderedPrinter in_order(results, options.json_lines && options.update.empty());
  std::atomic<std::size_t> next = 0;
  std::vector<std::exception_ptr> errors(static_cast<std::size_t>(jobs));
  const auto work = [&](std::size_t job) {
    try {
      for (std::size_t n = next++; n < cases.size() && stop_signal() == 0; n = next++) {
        CompareOptions one = tolerances.of(cases[n].name);
        one.heat = !options.folder.empty();
        one.threads = std::max(1, threads / jobs);
        in_order.put(n, compare_case(cases[n], one, memory));
      }
    } catch (const StopRequested&) { // this case has no result
      next = cases.size();
    } catch (...) {
      errors[job] = std::current_exception();
      next = cases.size();
    }
  };
  if (threads > jobs) start_threads(threads);
  {
    WorkerThreads others;
    while (1 + others.count() < jobs &&
           others.start([&work, job = static_cast<std::size_t>(1 + others.count())] { work(job); })) {
    }
    if ((1 + others.count() < jobs || threads_refused()) && !options.quiet) note_fewer_threads();
    work(0);
  }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  std::vector<CaseResult> out;
  for (auto& result : results)
    if (result) out.push_back(std::move(*result));
  if (out.size() < cases.size()) out.clear();
  return out;
}

std::vector<std::string> remarks_of(const Cases& cases, const Tolerances& tolerances) {
  std::vector<std::string> names;
  for (const CasePaths& one : cases.all) names.push_back(one.name);
  std::vector<std::string> out = tolerances.remarks(names);
  if (cases.left_out > 0)
    out.push_back(fmt::format("ignored {} non-PNG file{}", cases.left_out, cases.left_out == 1 ? "" : "s"));
  return out;
}

void print_report(const DiffOptions& options, const DiffReport& report) {
  if (options.json_lines) {
    for (std::size_t n = 0; n < report.cases.size() && !options.update.empty(); ++n)
      print_result(text_of(case_json(report.cases[n], report.expectation(n))) + "\n");
  } else if (options.json) {
    print_result(text_of(diff_json(report), 2) + "\n");
  } else if (!options.quiet) {
    print_result(diff_text(report) +
                 (options.folder.empty()
                      ? ""
                      : "  " + printable((fs::path(options.folder) / "index.html").string()) + "\n"));
  }
}

// No input may be overwritten.
void check_files(const DiffOptions& options, const Cases& cases) {
  NamedFiles files;
  for (const char* file : {"index.html", "diff.json"})
    if (!options.folder.empty()) files.writes("the report", fs::path(options.folder) / file);
  if (!options.junit.empty()) files.writes("--junit", resolve_link(options.junit));
  if (!options.gitlab.empty()) files.writes("--gitlab", resolve_link(options.gitlab));
  if (!options.github.empty()) files.writes("--github", resolve_link(options.github));
  if (!options.tolerances.empty()) files.reads("the file of tolerances", options.tolerances);
  if (!options.mask.empty()) files.reads("the mask", options.mask);
  for (const CasePaths& one : cases.all)
    for (const fs::path& picture : {one.a, one.b})
      if (!picture.empty() && !(options.junit + options.gitlab + options.github).empty())
        files.reads("the picture", picture);
}

// A report within a compared folder would itself be compared the next time, since its difference maps have the
// names of the pictures that differ.
void check_folder(const fs::path& report, const Cases& cases) {
  std::vector<fs::path> pictures = cases.folders;
  for (const CasePaths& one : cases.all)
    if (cases.folders.empty()) pictures.insert(pictures.end(), {one.a, one.b});
  for (const fs::path& inputs : pictures) {
    if (lies_in(report, inputs))
      throw UserError(Exit::Usage, {},
                      fmt::format("-o {} lies in {}, whose pictures are compared", in_quotes(report.string()),
                                  in_quotes(inputs.string())),
                      "choose a folder beside it for the report");
    if (lies_in(inputs, report / "maps"))
      throw UserError(Exit::Usage, {},
                      fmt::format("-o {} would write its maps into {}, which is compared",
                                  in_quotes(report.string()), in_quotes(inputs.string())),
                      "choose another folder for the report");
  }
}

Exit diff(const DiffOptions& options) {
  require_png();
  const Tolerances tolerances = tolerances_of(options);
  const Cases cases = cases_of(options.a, options.b);
  const std::set<std::size_t> chosen = named_cases(options.update, cases.all);
  check_files(options, cases);
  if (!options.folder.empty()) check_folder(options.folder, cases);
  if (!options.update.empty()) check_folders_of_update(options.a, options.b);
  const GracefulStop graceful_stop;
  DiffReport report;
  report.a = options.a;
  report.b = options.b;
  report.remarks = remarks_of(cases, tolerances);
  DiffFiles files({options.folder, options.junit, options.gitlab, options.github});
  MemoryBudget memory(MemoryBudget::of_machine(available_memory()));
  report.cases = compare_all(cases.all, tolerances, options, memory);
  if (report.cases.empty()) {
    print_error("stopped by a signal: no report was written");
    return exit_code_of_signal();
  }
  report.updated.assign(report.cases.size(), false);
  const std::set<std::size_t> changed = updatable(report.cases, chosen, memory);
  for (const std::size_t n : changed) report.updated[n] = true;
  for (const std::size_t n : chosen)
    if (report.cases[n].paths.b.empty() && !changed.contains(n))
      report.remarks.push_back(report.cases[n].paths.name +
                               ": not removed, since it is no picture that can be read");
  report.clips = clips_of(report.cases);
  // made before the update: it shows the old expected pictures
  const std::string page = options.folder.empty() ? "" : diff_page(report);
  update_expected(report.cases, changed, options.a);
  files.write(page, report);
  if (!options.quiet)
    for (const std::string& remark : report.remarks) print_note(remark);
  print_report(options, report);
  return exit_of(report);
}

// The parser gives --update all words up to the next option, the folders too where they stand behind it: these
// are its last.
void take_back_folders(DiffOptions& options) {
  for (std::string* folder : {&options.b, &options.a}) {
    if (!folder->empty() || options.update.size() < 2) continue;
    *folder = options.update.back();
    options.update.pop_back();
  }
  for (const auto& [given, name] : {std::pair(options.a, "EXPECTED"), std::pair(options.b, "NOW")})
    if (given.empty())
      throw UserError(Exit::Usage, {}, fmt::format("{} is missing", name),
                      "rend diff --help lists what it takes");
}

// An input that cannot be compared gives exit code 2 (trouble), as in diff(1). A file that is not there has the
// exit code that it has everywhere.
Exit run(DiffOptions& options) {
  take_back_folders(options);
  try {
    return diff(options);
  } catch (const UserError& error) {
    if (error.code != Exit::BadInput) throw;
    print_error(error.what(), error.hint);
    return Exit::DiffError;
  }
}

std::function<Exit()> declare_diff(const CommandLine& app) {
  auto options = std::make_shared<DiffOptions>();
  app.add_option("expected", options->a, "the expected picture (PNG), or a folder of pictures")
      .group(required_by_command)
      .type_name("EXPECTED");
  app.add_option("now", options->b,
                 "the picture to compare with it, or a folder with pictures of the same names")
      .group(required_by_command)
      .type_name("NOW");
  app.add_option("-t,--tolerances", options->tolerances,
                 "which differences are allowed, by picture (rend help tolerances); without it, none")
      .type_name("FILE.xml");
  app.add_option("--limit", options->limits,
                 "set one limit for all pictures, such as max=1, flip=0.002, share=any or threshold=4 (can be "
                 "repeated)")
      .type_name("NAME=VALUE")
      .allow_extra_args(false);
  app.add_option("--mask", options->mask,
                 "a PNG of the same size: white pixels are compared, black ones are not")
      .type_name("FILE.png");
  app.add_flag("--allow-path", options->allow_path, "allow masks outside of the folder of the tolerances");
  app.add_option(
         "-o,--output", options->folder,
         "folder for a report: index.html, diff.json and maps of the differences; default: none is written")
      .type_name("DIR");
  app.add_option("--gitlab", options->gitlab,
                 "also write the failures as a GitLab Code Quality report to this file")
      .type_name("FILE.json");
  app.add_option("--github", options->github,
                 "also write the failures as GitHub annotations (workflow commands) to this file")
      .type_name("FILE");
  app.add_option("--junit", options->junit, "also write the results as JUnit XML to this file")
      .type_name("FILE.xml");
  const Option json = app.add_flag("--json", options->json, "print the results as one JSON object on stdout");
  app.add_flag("--json-lines", options->json_lines,
               "print one JSON object per picture on stdout, one a line, each as soon as it is known")
      .excludes(json);
  app.add_option("--update", options->update,
                 "accept what there is now: names of pictures or folders, or patterns such as 'tear/*' or '*'; "
                 "new pictures are added to what is expected, and missing ones are removed from it")
      .type_name("NAME...")
      .expected(1, -1);
  app.add_option("--threads", options->threads, "number of threads; default: all that the machine has")
      .type_name("N")
      .transform(whole_number(1, 256));
  app.add_flag("-q,--quiet", options->quiet, "print nothing but JSON and errors");
  app.footer("Exit code: 0 if all pictures match, 1 if one does not, 2 if one cannot be compared.");
  return [options] { return run(*options); };
}

} // namespace

Command diff_command() {
  return {"diff", "compare pictures, or folders of pictures", declare_diff};
}

} // namespace rend
