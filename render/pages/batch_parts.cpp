#include "render/pages/batch_parts.h"

#include "render/batch/result_json.h"
#include "render/console/json_text.h"
#include "render/files/output.h"
#include "sim/base/error.h"
#include "sim/base/hash.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <map>

namespace rend {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path part_file(const fs::path& folder, const Shard& shard) {
  return folder / fmt::format("index.{}-of-{}.json", shard.number, shard.count);
}

int rank(BatchState state) {
  switch (state) {
  case BatchState::Done:
    return 0;
  case BatchState::Stopped:
    return 1;
  case BatchState::Unstable:
    return 2;
  case BatchState::Failed:
    return 3;
  }
  return 3;
}

// Of two parts of one job.
void add(BatchResult& sum, const BatchResult& part) {
  if (rank(part.state()) > rank(sum.state())) {
    sum.ran = part.ran;
    sum.code = part.code;
    sum.message = part.message;
  }
  sum.tries = std::max(sum.tries, part.tries);
  sum.seconds += part.seconds;
  sum.peak = std::max(sum.peak, part.peak);
  sum.log += part.log;
  if (!part.figures) return;
  if (!sum.figures) {
    sum.figures = part.figures;
    return;
  }
  sum.figures->pictures.made += part.figures->pictures.made;
  sum.figures->pictures.kept += part.figures->pictures.kept;
}

using Results = std::map<std::string, BatchResult>; // by name of the job

// False: the part is not there, of another batch, or no such file.
bool take_part(const fs::path& file, const std::string& key, Results& results, double& seconds) {
  std::ifstream stream(file);
  const Json json = Json::parse(stream, nullptr, false);
  try {
    if (json.is_discarded() || json.at("batch").get<std::string>() != key) return false;
    seconds = std::max(seconds, json.at("seconds").get<double>());
    for (const Json& one : json.at("jobs")) {
      const BatchResult result = result_from(one);
      const auto [at, is_new] = results.try_emplace(one.at("job").get<std::string>(), result);
      if (!is_new) add(at->second, result);
    }
    return true;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

} // namespace

std::string batch_key(const std::vector<BatchJob>& all, const std::vector<std::string>& settings) {
  std::string words;
  for (const BatchJob& job : all) words += job.name + '\n' + job.preset + '\n';
  for (const std::string& each : settings) words += each + '\n';
  return fmt::format("{:016x}", hash_bytes(words.data(), words.size()));
}

void remove_part(const fs::path& folder, const Shard& shard) {
  std::error_code none;
  fs::remove(part_file(folder, shard), none);
}

void write_part(const BatchReport& report, const Shard& shard, const std::string& key) {
  Json jobs = Json::array();
  for (std::size_t n = 0; n < report.jobs.size(); ++n)
    jobs.push_back(stored_result(report.jobs[n], report.results[n]));
  const Json whole{{"batch", key}, {"seconds", report.seconds}, {"jobs", jobs}};
  write_atomically(part_file(report.folder, shard), text_of(whole) + "\n");
}

std::optional<BatchReport> whole_batch(const fs::path& folder, const std::vector<BatchJob>& all, long shards,
                                       const std::string& key) {
  Results results;
  BatchReport report{folder, all, {}, {}, 0};
  for (long n = 1; n <= shards; ++n)
    if (!take_part(part_file(folder, {n, shards}), key, results, report.seconds)) return {};
  for (const BatchJob& job : all) {
    const auto found = results.find(job.name);
    if (found == results.end()) return {};
    report.results.push_back(found->second);
  }
  return report;
}

} // namespace rend
