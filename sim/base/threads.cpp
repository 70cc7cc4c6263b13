#include "sim/base/threads.h"

#include "sim/base/start_threads.h"
#include "sim/base/worker_threads.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace rend {

namespace {

// Kept, since creating an arena takes longer than a product with a small matrix.
tbb::task_arena& arena_of(int threads) {
  thread_local std::map<int, tbb::task_arena> arenas;
  return arenas.try_emplace(threads, threads).first->second;
}

// most: upper bound once the system has refused
std::atomic<int> started = 1, most = std::numeric_limits<int>::max();
std::mutex one_at_a_time; // held while threads are started

// Keeps the workers busy until all have started. Static, as the task of a refused worker may outlive the call.
std::atomic<int> round_over = 0;

// oneTBB starts threads lazily, some of them from within tasks. If the system refuses one there, it throws amid
// the running work, whose other tasks continue with dangling references, or it ends the program. So plain
// threads are tried first, then oneTBB's own are started here one after another, each kept busy until all have
// started. A refusal here is harmless.
int start_workers(int wanted) {
  struct Round {
    const int number = round_over + 1;
    ~Round() {
      round_over = number;
      round_over.notify_all();
    }
  } const round;
  int threads = 1;
  try {
    for (; threads < wanted; ++threads) {
      tbb::task_arena one(2);
      one.enqueue([number = round.number] {
        for (int now = round_over; now < number; now = round_over) round_over.wait(now);
      });
    }
  } catch (const std::runtime_error&) {
  }
  return threads;
}

void start_more(int wanted) {
  const std::lock_guard lock(one_at_a_time);
  wanted = std::min<int>(wanted, most);
  if (started >= wanted) return;
  const int threads = start_workers(1 + startable_threads(wanted - 1));
  if (threads < wanted) {
    most = threads;
    // A limit for all arenas together, since their own threads may ask for more.
    static const tbb::global_control bound(tbb::global_control::max_allowed_parallelism,
                                           static_cast<std::size_t>(threads));
  }
  if (threads > started) started = threads;
}

} // namespace

int start_threads(int wanted) {
  // With more than the machine has, oneTBB would warn on stderr.
  wanted = std::min({wanted, tbb::info::default_concurrency(), most.load()});
  if (started < wanted) start_more(wanted);
  return std::max(1, std::min<int>(started, wanted));
}

bool threads_refused() {
  return most < std::numeric_limits<int>::max();
}

void parallel_ranges(int parts, std::size_t count, RangeFunction work) {
  if (parts <= 1) return work(0, count);
  const auto n = static_cast<std::size_t>(parts);
  const auto one = [&](std::size_t part) { work(count * part / n, count * (part + 1) / n); };
  const int threads = start_threads(parts);
  if (threads == 1) {
    for (std::size_t part = 0; part < n; ++part) one(part);
    return;
  }
  arena_of(threads).execute([&] { tbb::parallel_for(std::size_t{0}, n, one, tbb::simple_partitioner()); });
}

int hardware_threads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

} // namespace rend
