// Loops of a scheme over all vertices, at the chosen vector unit and on as many threads as the system is worth.
//
// A loop takes [begin, end) first, then the system, then what it is given. One that puts the new state takes that state
// and a probe last (State::write): probes are summed up over stretches of vertices and then in their order, so that how
// many threads there are does not show.
#pragma once

#include "sim/integrate/system.h"
#include "sim/program/threads.h"

#include <algorithm>

namespace rend {

template <auto loop, class... A> void over_vertices(const System& system, A&&... a) {
  in_parts(system.parts(), system.vertices(),
           [&](std::size_t begin, std::size_t end) { at_width<loop>(begin, end, system, a...); });
}

constexpr std::size_t probed_vertices = 4096; // in a stretch

template <auto loop, class... A> void put_vertices(const System& system, State& next, A&&... a) {
  const std::size_t count = system.vertices(), stretches = (count + probed_vertices - 1) / probed_vertices;
  if (stretches <= 1) return at_width<loop>(std::size_t{0}, count, system, a..., next, next.probe);
  thread_local std::vector<Record> probes;
  probes.resize(stretches);
  Record* const seen = probes.data();
  in_parts(system.parts(), stretches, [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) {
      Double4 probe{};
      at_width<loop>(n * probed_vertices, std::min(count, (n + 1) * probed_vertices), system, a..., next,
                     probe);
      store(seen[n], probe);
    }
    if (next.large) finish_streams(); // other threads are going to read them
  });
  for (const Record& one : probes) next.probe += load(one);
}

} // namespace rend
