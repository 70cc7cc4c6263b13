#include "render/commands/batch_run.h"

#include "render/batch/result_json.h"
#include "render/console/console.h"
#include "render/console/json_text.h"
#include "render/files/output.h"
#include "render/files/output_folder.h"
#include "sim/base/printable.h"
#include "sim/base/wording.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace rend {
namespace {

void write_log(const BatchReport& report, const BatchJob& job, const BatchResult& result) {
  const std::filesystem::path file = log_file(report, job);
  const OutputFolder folder(file.parent_path());
  folder.make();
  write_atomically(file, result.log);
}

} // namespace

BatchRun::BatchRun(BatchReport& report, const KeptResults* kept, const BatchTelling& telling,
                   std::vector<std::optional<BatchResult>> there)
    : report_(report), kept_(kept), telling_(telling) {
  report_.results.resize(report_.jobs.size());
  for (std::size_t n = 0; n < report_.jobs.size(); ++n) {
    if (there[n]) {
      report_.results[n] = std::move(*there[n]);
      tell_json(n);
    } else {
      missing_.push_back(report_.jobs[n]);
      places_.push_back(n);
    }
  }
}

void BatchRun::run(const BatchQueue::CommandOf& command) {
  BatchQueue queue(missing_, report_.limits, command,
                   [&](std::size_t n, const BatchResult& result) { end(places_[n], result); });
  const std::vector<BatchResult> results = queue.run();
  for (std::size_t n = 0; n < results.size(); ++n) report_.results[places_[n]] = results[n];
  if (queue.processes_were_refused() && !telling_.quiet)
    print_note("the system could not start as many jobs at once as --jobs allows: fewer ran side by side");
}

void BatchRun::end(std::size_t n, const BatchResult& result) {
  const BatchJob& job = report_.jobs[n];
  ++finished_;
  report_.results[n] = result;
  write_log(report_, job, result);
  if (kept_) kept_->keep(job, result);
  tell_json(n);
  if (telling_.quiet) return;
  print_progress(fmt::format("{:>3} of {}  {:8}  {:>8}  {}{}\n", finished_, missing_.size(),
                             name_of(result.state()), seconds_in_words(result.seconds), printable(job.name),
                             time_left()));
  if (telling_.warns_of_memory) warn_of_memory(job, result);
}

void BatchRun::tell_json(std::size_t n) const {
  if (telling_.json) print_result(text_of(line_of(report_.jobs[n], report_.results[n])) + "\n");
}

// "about 3 min 20 s left": as if the other jobs took as long as those that have ended.
std::string BatchRun::time_left() const {
  if (finished_ == missing_.size()) return "";
  const double each = (wall_clock() - start_) / static_cast<double>(finished_);
  return fmt::format("  about {} left",
                     seconds_in_words(std::ceil(each * static_cast<double>(missing_.size() - finished_))));
}

// One job always runs, even if it takes more than all may take together: then it is told.
void BatchRun::warn_of_memory(const BatchJob& job, const BatchResult& result) {
  if (warned_ || result.peak <= report_.limits.memory) return;
  warned_ = true;
  print_note(
      fmt::format("--memory allows {} for all jobs together, but {} alone took {}: jobs that large run one "
                  "after another; allow more, or make them smaller",
                  bytes_in_words(report_.limits.memory), in_quotes(job.name), bytes_in_words(result.peak)));
}

} // namespace rend
