// Counters per element or row [ns], instead of the time of a whole benchmark.
#pragma once

#include <benchmark/benchmark.h>

namespace rend {

inline void count_elements(benchmark::State& state, double elements) {
  using benchmark::Counter;
  state.counters["elements"] = elements;
  state.counters["ns_per_element"] =
      Counter(1e-9 * elements, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

} // namespace rend
