// What a figure says: the time of an element or a row [ns], whatever its benchmark takes for all of them.
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
