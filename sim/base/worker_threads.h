// Threads beside the calling one, which a system may refuse to start: their number is limited (ulimit -u, a
// control group), or there is no memory for their stacks.
//
// A std::thread says so by an exception, and what is built around several of them then lets go of those that
// run, which ends the program (std::terminate). Here a refusal is an answer, and whoever asks decides whether
// fewer will do. Libraries that start threads of their own decide badly: llvmpipe waits for ever for one that
// was refused, oneTBB ends the program. They are told beforehand how many there can be.
#pragma once

#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace rend {

class WorkerThreads {
public:
  WorkerThreads() = default;
  ~WorkerThreads(); // waits
  WorkerThreads(const WorkerThreads&) = delete;
  WorkerThreads& operator=(const WorkerThreads&) = delete;

  // False: the system starts no more; nothing has changed. `work` is not to throw.
  bool start(std::function<void()> work);
  void wait(); // until all have ended; then there are none
  int count() const { return static_cast<int>(threads_.size()); }

private:
  std::vector<std::thread> threads_;
};

// How many of so many more threads the system starts now, found out by trying.
int startable_threads(int wanted);

// Throws UserError (OutOfBudget): "a thread for WHAT could not be started".
[[noreturn]] void refuse_without_thread(const std::string& what);

// How many starts the system has refused so far, of any library. Counted in programs that have
// render/commands/thread_starts.cpp; elsewhere 0.
long refused_thread_starts();
void count_refused_thread_start();

} // namespace rend
