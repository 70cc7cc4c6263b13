#include "render/studies/check_run.h"

#include "render/console/signals.h"
#include "render/files/output.h"
#include "render/picture/mask_file.h"
#include "render/picture/scene_preset.h"
#include "sim/base/stop_request.h"
#include "sim/base/worker_threads.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <exception>
#include <mutex>
#include <optional>

namespace rend {

namespace fs = std::filesystem;

std::string file_name(const std::string& case_name) {
  std::string name;
  for (const char c : case_name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
    if (plain || (!name.empty() && name.back() != '-')) name += plain ? c : '-';
  }
  return name;
}

void write_cases(const fs::path& folder, const std::vector<CheckCase>& cases) {
  for (const CheckCase& each : cases) {
    if (each.preset.empty()) continue;
    write_atomically(folder / (file_name(each.name) + ".xml"), each.preset);
    for (const auto& [name, content] : each.files) write_atomically(folder / name, content);
  }
}

std::vector<CheckResult> run_cases(const fs::path& folder, const std::vector<CheckCase>& cases, int jobs,
                                   const std::function<void(std::size_t, const CheckResult&)>& done,
                                   const std::function<void()>& fewer) {
  const ReadPreset read = [&](const CheckCase& which, const std::string* instead, const Sets& sets) {
    std::vector<Override> overrides;
    for (const auto& [path, value] : sets) overrides.push_back({path, value});
    if (instead) return load_scene_text(*instead, which.name, overrides);
    if (which.preset.empty()) return load_scene(which.path, overrides);
    return load_scene(folder / (file_name(which.name) + ".xml"), overrides);
  };
  std::vector<std::optional<CheckResult>> results(cases.size());
  std::atomic<std::size_t> next = 0;
  std::mutex one_at_a_time;
  std::exception_ptr error;
  const auto work = [&] {
    try {
      for (std::size_t n = next++; n < cases.size() && stop_signal() == 0; n = next++) {
        results[n] = run_case(cases[n], read, {.is_textured = {}, .read_mask = read_mask});
        const std::lock_guard lock(one_at_a_time);
        done(n, *results[n]);
      }
    } catch (const StopRequested&) { // the case has no result
      next = cases.size();
    } catch (...) {
      const std::lock_guard lock(one_at_a_time);
      if (!error) error = std::current_exception();
      next = cases.size();
    }
  };
  {
    WorkerThreads others;
    while (1 + others.count() < jobs && others.start(work)) {
    }
    if (1 + others.count() < jobs) fewer();
    work();
  }
  if (error) std::rethrow_exception(error);
  std::vector<CheckResult> all;
  for (auto& result : results)
    if (result) all.push_back(std::move(*result));
  return all;
}

} // namespace rend
