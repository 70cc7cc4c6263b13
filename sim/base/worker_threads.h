// Threads that the system may refuse to start: their number is limited (ulimit -u, a control group), or there
// is no memory for their stacks.
//
// A std::thread reports this by an exception; code that is starting several of them then destroys the running
// ones without joining, which ends the program (std::terminate). Here a refusal is a return value, and the
// caller decides whether fewer threads will do. Libraries that start their own threads handle it badly:
// llvmpipe waits for ever for a thread that was refused, oneTBB ends the program. They are told beforehand how
// many threads there can be.
#pragma once

#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace rend {

class WorkerThreads {
public:
  WorkerThreads() = default;
  ~WorkerThreads(); // joins all
  WorkerThreads(const WorkerThreads&) = delete;
  WorkerThreads& operator=(const WorkerThreads&) = delete;

  // False: the system refused; nothing has changed. `work` must not throw.
  bool start(std::function<void()> work);
  void wait(); // joins all; then there are none
  int count() const { return static_cast<int>(threads_.size()); }

private:
  std::vector<std::thread> threads_;
};

// How many of `wanted` further threads the system would start now, found by trying.
int startable_threads(int wanted);

// Throws UserError (OutOfBudget): "a thread for WHAT could not be started".
[[noreturn]] void refuse_without_thread(const std::string& what);

// How many thread starts the system has refused so far, in any library. Counted only in programs that link
// render/commands/thread_starts.cpp; elsewhere 0.
long refused_thread_starts();
void count_refused_thread_start();

} // namespace rend
