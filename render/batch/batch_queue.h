// Jobs of a batch in parallel, as many as there is room for.
//
// What a job takes is not known before it ran: what another job of the same preset took is expected of it, else
// the mean of all so far. One more is begun where what runs and what is expected of it fit into the budget; one
// always runs. Where what runs outgrows the budget nevertheless, the job begun last is stopped with a
// checkpoint (SIGTERM), and goes on from there when there is room. Where the system starts no more programs as
// many run as do then.
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
  std::size_t memory = 0; // [bytes], of all together
};

class BatchQueue {
public:
  // `command`: the arguments of a job's program; `again`: it was stopped for want of room, and left a
  // checkpoint.
  using CommandOf = std::function<std::vector<std::string>(const BatchJob& job, bool again)>;
  using Done = std::function<void(std::size_t job, const BatchResult& result)>;
  BatchQueue(const std::vector<BatchJob>& jobs, const BatchLimits& limits, CommandOf command, Done done);

  // Until all ran, or a signal came: then those that run are stopped, and waited for.
  std::vector<BatchResult> run();
  bool has_fewer_jobs() const { return fewer_jobs_; } // at once than it was to have: the system starts no more

private:
  struct Running {
    std::size_t job;
    Child child;
    double since;         // [s]
    std::size_t most = 0; // [bytes], seen so far
    bool stopped = false; // to make room
  };
  std::size_t expected(const std::string& preset) const;
  std::size_t taken() const; // by what runs, now or later
  bool room_for_next() const;
  void begin_next();
  void collect();
  void watch_memory();
  void stop_all(int signal);
  void finish(Running& one);

  const std::vector<BatchJob>& jobs_;
  BatchLimits limits_;
  CommandOf command_;
  Done done_;
  std::deque<std::size_t> waiting_;
  std::list<Running> running_; // in the order in which they were begun
  std::vector<BatchResult> results_;
  std::vector<bool> again_; // of each job
  bool fewer_jobs_ = false;
  std::map<std::string, std::size_t> peaks_; // [bytes], of a preset
};

} // namespace rend
