// Runs the jobs of a batch that have no result yet, and tells of each as it ends: its log, its line of JSON,
// progress.
#pragma once

#include "render/batch/batch_queue.h"
#include "render/batch/kept_results.h"
#include "render/pages/batch_page.h"
#include "sim/base/wall_clock.h"

#include <optional>
#include <vector>

namespace rend {

struct BatchTelling {
  bool json = false, quiet = false;
  bool warns_of_memory = false; // of a job that takes more than all may
};

class BatchRun {
public:
  // `there`: results that exist, one per job of the report; `kept`: where results are kept, or null.
  BatchRun(BatchReport& report, const KeptResults* kept, const BatchTelling& telling,
           std::vector<std::optional<BatchResult>> there);
  void run(const BatchQueue::CommandOf& command); // fills the report's results

private:
  void end(std::size_t job, const BatchResult& result);
  void tell_json(std::size_t job) const;
  std::string time_left() const;
  void warn_of_memory(const BatchJob& job, const BatchResult& result);

  BatchReport& report_;
  const KeptResults* kept_;
  BatchTelling telling_;
  bool warned_ = false;
  std::vector<BatchJob> missing_;
  std::vector<std::size_t> places_; // of these in the report
  std::size_t finished_ = 0;
  double start_ = wall_clock(); // [s]
};

} // namespace rend
