#include "sim/program/threads.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <thread>

namespace rend {

void in_parts(int parts, std::size_t count, PartWork work) {
  if (parts <= 1) return work(0, count);
  const auto n = static_cast<std::size_t>(parts);
  tbb::task_arena arena(std::min(parts, tbb::info::default_concurrency())); // more, and oneTBB warns on stderr
  arena.execute([&] {
    tbb::parallel_for(
        std::size_t{0}, n, [&](std::size_t part) { work(count * part / n, count * (part + 1) / n); },
        tbb::simple_partitioner());
  });
}

int hardware_threads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

} // namespace rend
