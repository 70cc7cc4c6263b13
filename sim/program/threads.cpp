#include "sim/program/threads.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <thread>

namespace rend {

namespace {

// To make one takes longer than a product of a small matrix.
tbb::task_arena& arena_of(int threads) {
  thread_local std::map<int, tbb::task_arena> arenas;
  return arenas.try_emplace(threads, threads).first->second;
}

} // namespace

void in_parts(int parts, std::size_t count, PartWork work) {
  if (parts <= 1) return work(0, count);
  const auto n = static_cast<std::size_t>(parts);
  // More than the machine has, and oneTBB warns on stderr.
  arena_of(std::min(parts, tbb::info::default_concurrency())).execute([&] {
    tbb::parallel_for(
        std::size_t{0}, n, [&](std::size_t part) { work(count * part / n, count * (part + 1) / n); },
        tbb::simple_partitioner());
  });
}

int hardware_threads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

} // namespace rend
