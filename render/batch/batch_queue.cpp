#include "render/batch/batch_queue.h"

#include "render/clip/session.h"
#include "render/console/signals.h"
#include "sim/base/error.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

namespace rend {
namespace {

constexpr std::size_t unknown = std::size_t{200}
                                << 20U; // [bytes], expected of the first jobs: more than small presets take
constexpr std::chrono::milliseconds pause_between(10); // between two polls

} // namespace

BatchQueue::BatchQueue(const std::vector<BatchJob>& jobs, const BatchLimits& limits, CommandOf command,
                       Done done)
    : jobs_(jobs), limits_(limits), command_(std::move(command)), done_(std::move(done)), results_(jobs.size()),
      resumes_(jobs.size()) {
  for (std::size_t n = 0; n < jobs.size(); ++n) waiting_.push_back(n);
}

std::size_t BatchQueue::expected(const std::string& preset) const {
  if (const auto known = peaks_.find(preset); known != peaks_.end()) return known->second;
  std::size_t sum = 0;
  for (const auto& [name, bytes] : peaks_) sum += bytes;
  return peaks_.empty() ? unknown : sum / peaks_.size();
}

std::size_t BatchQueue::memory_in_use() const {
  std::size_t sum = 0;
  for (const Running& one : running_) sum += std::max(one.most, expected(jobs_[one.job].preset));
  return sum;
}

bool BatchQueue::room_for_next() const {
  if (waiting_.empty()) return false;
  if (running_.empty()) return true;
  return static_cast<int>(running_.size()) < limits_.jobs &&
         memory_in_use() + expected(jobs_[waiting_.front()].preset) <= limits_.memory;
}

void BatchQueue::start_next() {
  const std::size_t job = waiting_.front();
  waiting_.pop_front();
  // llvmpipe draws the same with any number of threads; with several jobs, more than one thread each would only
  // compete for the processors.
  std::vector<std::pair<std::string, std::string>> variables;
  if (limits_.jobs > 1) variables.emplace_back("LP_NUM_THREADS", "1");
  try {
    running_.push_back({job, Child(command_(jobs_[job], resumes_[job]), variables), wall_clock()});
  } catch (const UserError& error) {
    if (error.code != Exit::OutOfBudget || running_.empty()) throw;
    waiting_.push_front(job);
    limits_.jobs = static_cast<int>(running_.size());
    processes_were_refused_ = true;
  }
}

void BatchQueue::finish(Running& one) {
  BatchResult& result = results_[one.job];
  result.seconds += wall_clock() - one.since;
  result.peak = std::max(result.peak, one.child.peak());
  const std::string& preset = jobs_[one.job].preset;
  peaks_[preset] = std::max(peaks_[preset], result.peak);
  const bool stopped = is_exit_code_of_signal(one.child.code());
  ++result.tries;
  // A job that was stopped to free memory resumes once there is room, from its checkpoint if it wrote one. It
  // did if it printed its figures; it did not if it was still building its scene (a checkpoint found then is of
  // an earlier batch).
  if (stopped && one.stopped && stop_signal() == 0) {
    resumes_[one.job] = resumes_[one.job] || !one.child.out().empty();
    waiting_.push_back(one.job);
    return;
  }
  const bool ran = !(stopped && stop_signal() != 0);
  take_end(result, one.child, ran);
  done_(one.job, result);
}

void BatchQueue::collect() {
  for (auto one = running_.begin(); one != running_.end();) {
    one->most = std::max(one->most, one->child.resident());
    if (one->child.running()) {
      ++one;
      continue;
    }
    finish(*one);
    one = running_.erase(one);
  }
}

// Stops the job that was started last, unless one is being stopped already.
void BatchQueue::watch_memory() {
  std::size_t sum = 0;
  for (const Running& one : running_) sum += one.child.resident();
  if (sum <= limits_.memory || running_.size() < 2) return;
  if (std::any_of(running_.begin(), running_.end(), [](const Running& one) { return one.stopped; })) return;
  Running& last = running_.back();
  last.stopped = true;
  peaks_[jobs_[last.job].preset] = std::max(peaks_[jobs_[last.job].preset], last.most);
  last.child.signal(SIGTERM);
}

void BatchQueue::stop_all(int signal) {
  for (const Running& one : running_) one.child.signal(signal);
  while (!running_.empty()) {
    collect();
    std::this_thread::sleep_for(pause_between);
  }
}

std::vector<BatchResult> BatchQueue::run() {
  while (!waiting_.empty() || !running_.empty()) {
    if (const int signal = stop_signal(); signal != 0) {
      stop_all(signal);
      break;
    }
    while (room_for_next()) start_next();
    collect();
    watch_memory();
    std::this_thread::sleep_for(pause_between);
  }
  return results_;
}

} // namespace rend
