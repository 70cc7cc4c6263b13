#include "sim/base/worker_threads.h"

#include "sim/base/error.h"

#include <atomic>
#include <pthread.h>
#include <system_error>
#include <utility>

namespace rend {

WorkerThreads::~WorkerThreads() {
  wait();
}

bool WorkerThreads::start(std::function<void()> work) {
  try {
    threads_.emplace_back(std::move(work));
    return true;
  } catch (const std::system_error&) {
    return false;
  }
}

void WorkerThreads::wait() {
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

// A std::thread is not used here: one that allocates memory reserves an arena of addresses, maybe more than are
// left where address space is limited.
int startable_threads(int wanted) {
  std::atomic<bool> done = false;
  const auto wait = [](void* it) -> void* {
    static_cast<std::atomic<bool>*>(it)->wait(false);
    return nullptr;
  };
  std::vector<pthread_t> threads;
  threads.reserve(static_cast<std::size_t>(wanted));
  pthread_t one{};
  for (int n = 0; n < wanted && pthread_create(&one, nullptr, wait, &done) == 0; ++n) threads.push_back(one);
  done = true;
  done.notify_all();
  for (const pthread_t& thread : threads) pthread_join(thread, nullptr);
  return static_cast<int>(threads.size());
}

void refuse_without_thread(const std::string& what) {
  throw UserError(Exit::OutOfBudget, {}, "a thread for " + what + " could not be started",
                  "run fewer programs at once, or allow more threads (ulimit -u, pids.max of a control group) "
                  "and memory");
}

namespace {
std::atomic<long> refused = 0;
}

long refused_thread_starts() {
  return refused;
}

void count_refused_thread_start() {
  ++refused;
}

} // namespace rend
