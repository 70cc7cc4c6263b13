#include "render/batch/kept_results.h"

#include "render/batch/result_json.h"
#include "render/clip/checkpoint.h"
#include "render/clip/inputs.h"
#include "render/console/json_text.h"
#include "render/files/output.h"
#include "render/files/output_folder.h"
#include "render/picture/scene_preset.h"
#include "sim/base/hash.h"
#include "sim/preset/preset_reader.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace rend {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool is_to_be_kept(const BatchResult& result) {
  constexpr int answers_do_not_hold = static_cast<int>(Exit::CheckFailed);
  return result.ran && result.figures &&
         (result.done() || result.state() == BatchState::Unstable || result.code == answers_do_not_hold);
}

// Discarded where there is no such file, or no JSON in it.
Json read(const fs::path& file) {
  std::ifstream stream(file);
  return Json::parse(stream, nullptr, false);
}

} // namespace

KeptResults::KeptResults(const fs::path& folder, std::vector<std::string> settings)
    : folder_(folder / "results"), settings_(std::move(settings)) {}

fs::path KeptResults::file_of(const BatchJob& job) const {
  return folder_ / (job.name + ".json");
}

std::string KeptResults::key_of(const BatchJob& job) const {
  try {
    static const std::string program = checkpoint_key(std::string(16, '0'));
    std::vector<Override> overrides;
    std::string words = program + '\n';
    for (const auto* sets : {&settings_, &job.sets})
      for (const std::string& set : *sets) words += set + '\n';
    for (const std::string& set : job.sets) overrides.push_back(parse_override(set));
    const std::string text = read_preset_file(job.preset);
    words += text + '\n' + hashes_of_files(*load_scene_text(text, job.preset, overrides));
    return fmt::format("{:016x}", hash_bytes(words.data(), words.size()));
  } catch (const UserError&) {
    return {};
  }
}

std::optional<BatchResult> KeptResults::find(const BatchJob& job) const {
  const Json json = read(file_of(job));
  try {
    const std::string key = json.is_discarded() ? "" : key_of(job);
    if (key.empty() || json.at("key").get<std::string>() != key) return {};
    BatchResult result = result_from(json);
    return is_to_be_kept(result) ? std::optional(std::move(result)) : std::nullopt;
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

void KeptResults::keep(const BatchJob& job, const BatchResult& result) const {
  const std::string key = is_to_be_kept(result) ? key_of(job) : "";
  if (key.empty()) return remove(job);
  Json json = stored_result(job, result);
  json["key"] = key;
  const OutputFolder folder(file_of(job).parent_path());
  folder.make();
  write_atomically(file_of(job), text_of(json) + "\n");
}

void KeptResults::remove(const BatchJob& job) const {
  std::error_code none;
  fs::remove(file_of(job), none);
}

// Calls f(file, what stands in it) for every stored result in the folder. Other files are left alone.
template <class F> void KeptResults::for_each(F&& f) const {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder_, error), end; !error && at != end; at.increment(error))
    if (at->path().extension() == ".json") files.push_back(at->path());
  for (const fs::path& file : files)
    if (const Json json = read(file); json.is_object() && json.contains("key") && json.contains("printed"))
      f(file, json);
}

void KeptResults::remove_all() const {
  for_each([](const fs::path& file, const Json&) {
    std::error_code none;
    fs::remove(file, none);
  });
}

std::vector<std::pair<BatchJob, BatchResult>> KeptResults::others(const std::vector<BatchJob>& jobs) const {
  std::vector<std::pair<BatchJob, BatchResult>> all;
  for_each([&](const fs::path&, const Json& json) {
    try {
      const BatchJob job = job_from(json);
      if (std::any_of(jobs.begin(), jobs.end(), [&](const BatchJob& one) { return one.name == job.name; }))
        return;
      if (auto result = find(job)) all.emplace_back(job, std::move(*result));
    } catch (const nlohmann::json::exception&) {
      // it is something else
    }
  });
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first.name < b.first.name; });
  return all;
}

} // namespace rend
