// The cost of a walk: visits every orbit of a map once, from its smallest dart; an item is a dart.
#pragma once

#include "sim/embedding/cell_index.h"
#include "sim/topology/walk.h"

#include <benchmark/benchmark.h>

#include <vector>

namespace rend {

inline void walk_orbits(benchmark::State& state, const GMap& map, Orbit orbit) {
  const CellIndex cells(map, orbit);
  std::vector<Dart> darts;
  for (auto _ : state) {
    for (Slot s = 0; s < cells.slots(); ++s) {
      darts.clear();
      collect(map, orbit, cells.first_dart(s), darts);
      benchmark::DoNotOptimize(darts.data());
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(map.dart_count()));
}

} // namespace rend
