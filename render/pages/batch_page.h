// What came of a batch: one page with a picture of each job, and the same as JSON, one object a line.
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
  std::vector<BatchResult> results; // of each
  BatchLimits limits;
  double seconds = 0; // on the clock, of all
};

nlohmann::ordered_json line_of(const BatchJob& job, const BatchResult& result);
std::string batch_page(const BatchReport& report);

} // namespace rend
