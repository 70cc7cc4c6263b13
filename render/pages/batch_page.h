// The results of a batch: a page with a picture of each job, and the same as JSON lines.
#pragma once

#include "render/batch/batch_jobs.h"
#include "render/batch/batch_queue.h"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace rend {

struct BatchReport {
  std::filesystem::path folder;
  std::vector<BatchJob> jobs;
  std::vector<BatchResult> results; // one per job
  BatchLimits limits;
  double seconds = 0; // wall clock, of the whole batch
};

// logs/JOB.log in the batch's folder: what a job wrote to stderr.
std::filesystem::path log_file(const BatchReport& report, const BatchJob& job);

nlohmann::ordered_json line_of(const BatchJob& job, const BatchResult& result);
std::string batch_page(const BatchReport& report);

} // namespace rend
