// The results of a batch: a page with a picture of each job; of runs, with the main figures of each.
#pragma once

#include "render/batch/batch_jobs.h"
#include "render/batch/batch_queue.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rend {

struct BatchReport {
  std::filesystem::path folder;
  std::vector<BatchJob> jobs;
  std::vector<BatchResult> results; // one per job
  BatchLimits limits;
  double seconds = 0; // wall clock, of the whole batch
  bool runs = false;  // they make no pictures
};

// The file of all figures of a batch of runs, beside the page of this name.
std::string csv_name(const std::string& page); // "index": figures.csv

// logs/JOB.log in the batch's folder: what a job wrote to stderr.
std::filesystem::path log_file(const BatchReport& report, const BatchJob& job);

std::string batch_page(const BatchReport& report, const std::string& name); // of the page: "index"

} // namespace rend
