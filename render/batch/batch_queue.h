// Runs the jobs of a batch in parallel, as many as memory allows.
//
// The memory that a job takes is not known before it has run. The estimate is what another job of the same
// preset took, else the mean of all jobs so far. A job is started when the running jobs and its own estimate
// fit into the budget; one job always runs. If the running jobs outgrow the budget nevertheless, the one that
// was started last is stopped with a checkpoint (SIGTERM), and resumes from there when there is room. If the
// system refuses to start another process, the number of jobs that run by then becomes the limit.
#pragma once

#include "render/batch/batch_jobs.h"
#include "render/batch/batch_result.h"

#include <deque>
#include <functional>
#include <list>
#include <map>
#include <string>
#include <vector>

namespace rend {

struct BatchLimits {
  int jobs = 1;           // at once
  std::size_t memory = 0; // [bytes], for all jobs together
};

class BatchQueue {
public:
  // `command`: the arguments of a job's process; `again`: it was stopped to free memory and left a checkpoint.
  using CommandOf = std::function<std::vector<std::string>(const BatchJob& job, bool again)>;
  using Done = std::function<void(std::size_t job, const BatchResult& result)>;
  BatchQueue(const std::vector<BatchJob>& jobs, const BatchLimits& limits, CommandOf command, Done done);

  // Until all jobs have run or a signal came: then running jobs are stopped and waited for.
  std::vector<BatchResult> run();
  // the system refused to start as many processes as were asked for
  bool processes_were_refused() const { return processes_were_refused_; }

private:
  struct Running {
    std::size_t job;
    Child child;
    double since;         // [s]
    std::size_t most = 0; // [bytes], the largest resident size seen so far
    bool stopped = false; // to free memory
  };
  std::size_t expected(const std::string& preset) const;
  std::size_t memory_in_use() const; // [bytes] by running jobs, now or as estimated
  bool room_for_next() const;
  void start_next();
  void collect();
  void watch_memory();
  void stop_all(int signal);
  void finish(Running& one);

  const std::vector<BatchJob>& jobs_;
  BatchLimits limits_;
  CommandOf command_;
  Done done_;
  std::deque<std::size_t> waiting_;
  std::list<Running> running_; // in the order of their start
  std::vector<BatchResult> results_;
  std::vector<bool> resumes_; // one per job: it resumes from a checkpoint
  bool processes_were_refused_ = false;
  std::map<std::string, std::size_t> peaks_; // [bytes], by preset
};

} // namespace rend
