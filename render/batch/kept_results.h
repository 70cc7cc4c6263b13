// Results of the runs of a batch (rend batch --run), one file a job in results/ of the batch's folder, each
// written as its job ends. --resume takes those that still hold, and runs the others.
//
// A result holds for the same program file, preset, files that it names and attributes, which its key says.
// Kept is what another run would come to again: figures, also of a run that was stopped as unstable, or whose
// <answer> does not hold.
#pragma once

#include "render/batch/batch_jobs.h"
#include "render/batch/batch_result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rend {

class KeptResults {
public:
  // `folder`: of the batch; `settings`: what changes the figures of all jobs, such as PATH=VALUE.
  KeptResults(const std::filesystem::path& folder, std::vector<std::string> settings);

  // None: there is no result of this job, or it does not hold any more.
  std::optional<BatchResult> find(const BatchJob& job) const;
  void keep(const BatchJob& job, const BatchResult& result) const; // if it is worth it
  void remove(const BatchJob& job) const;
  void remove_all() const;
  // Those of other jobs that still hold, by name: of earlier batches into this folder.
  std::vector<std::pair<BatchJob, BatchResult>> others(const std::vector<BatchJob>& jobs) const;

private:
  template <class F> void for_each(F&& f) const;
  std::filesystem::path file_of(const BatchJob& job) const;
  std::string key_of(const BatchJob& job) const; // empty: its preset cannot be read

  std::filesystem::path folder_; // results/
  std::vector<std::string> settings_;
};

} // namespace rend
