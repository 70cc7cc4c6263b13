// Loops of a scheme over all vertices, with the chosen vector unit and number of threads.
//
// The arguments of a loop are [begin, end), the system, and its own ones. A loop that writes the new state has
// that state and a probe as last arguments (State::write): probes are summed over blocks of vertices and then
// over the blocks in order, so that results do not depend on threads or on how the loop is divided.
#pragma once

#include "sim/base/threads.h"
#include "sim/integrate/system.h"

#include <algorithm>

namespace rend {

template <auto loop, class... A> void over_vertices(const System& system, A&&... a) {
  parallel_ranges(system.parts(), system.vertices(),
                  [&](std::size_t begin, std::size_t end) { at_width<loop>(begin, end, system, a...); });
}

constexpr std::size_t probed_vertices = System::range_size;

// The probes for so many vertices, all 0; thread-local.
inline std::vector<Record>& probes_of(std::size_t vertices) {
  thread_local std::vector<Record> probes;
  probes.assign((vertices + probed_vertices - 1) / probed_vertices, Record{});
  return probes;
}

// A loop over the vertices of one block or a part of it.
template <auto loop, class... A> void write_range(std::size_t begin, std::size_t end, Record& seen, A&... a) {
  Double4 probe = load(seen);
  at_width<loop>(begin, end, a..., probe);
  store(seen, probe);
}

template <auto loop, class... A> void write_vertices(const System& system, State& next, A&&... a) {
  const std::size_t count = system.vertices();
  std::vector<Record>& probes = probes_of(count);
  Record* const seen = probes.data(); // a thread_local name would mean another object in another thread
  parallel_ranges(system.parts(), probes.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n)
      write_range<loop>(n * probed_vertices, std::min(count, (n + 1) * probed_vertices), seen[n], system, a...,
                        next);
    if (next.large) fence_streams(); // other threads read them next
  });
  for (const Record& one : probes) next.probe += load(one);
}

// The same while forces are evaluated: each block as soon as its forces are complete.
template <auto loop>
void sweep_vertices(System& system, double time, State& next, double step, const StateView& now,
                    Record* force) {
  std::vector<Record>& probes = probes_of(system.vertices());
  Record* const seen = probes.data();
  system.forces_in_ranges(time, now.position, now.velocity, force, [&](std::size_t begin, std::size_t end) {
    for (std::size_t to = begin; begin < end; begin = to) {
      to = std::min(end, (begin / probed_vertices + 1) * probed_vertices);
      write_range<loop>(begin, to, seen[begin / probed_vertices], system, step, now, force, next);
    }
    if (next.large) fence_streams();
  });
  for (const Record& one : probes) next.probe += load(one);
}

} // namespace rend
