// The changes of laws as functions of sim/fracture, and as built-in rules and scripts: per change, with
// the closing of the edit that all of an iteration share.
#include "sim/elements.h"
#include "sim/fracture/rule_change.h"
#include "sim/house_rules/house_scripts.h"
#include "sim/mesh/bar.h"
#include "sim/mesh/cells.h"
#include "sim/mesh/sheet.h"
#include "sim/topology/walk.h"

#include <benchmark/benchmark.h>

#include <array>
#include <memory>

namespace rend {
namespace {

struct Pair {
  const char* function;
  std::array<const char*, 2> script; // in sheets, in solids
};
constexpr std::array<Pair, 4> pairs{{{"separate", {"unsew-edge", "unsew-face"}},
                                     {"delete-element", {"delete-face", "delete-volume"}},
                                     {"split-vertex", {"split-vertex-of-sheet", "split-vertex-of-solid"}},
                                     {"delete-edge", {"delete-faces-at-edge", "delete-volumes-at-edge"}}}};

std::unique_ptr<Body> body_of(int dimension) {
  SheetShape sheet;
  sheet.pattern = SheetPattern::Quads;
  sheet.nx = sheet.ny = 60;
  sheet.size = {1, 1};
  return elements::elastic_body(dimension == 2
                                    ? sheet_from(sheet_polygons(sheet))
                                    : solid_from(bar_cells({BarPattern::Tetrahedra, 8, 8, 8, Vec3(1, 1, 1)})),
                                {});
}

// One cell of eleven: they hardly touch each other.
std::vector<std::vector<Dart>> some_cells(const GMap& map, Orbit orbit) {
  std::vector<std::vector<Dart>> cells;
  std::size_t count = 0;
  map.for_each_dart([&](Dart d) {
    if (smallest_dart(map, orbit, d) == d && count++ % 11 == 0) cells.push_back(darts_of(map, orbit, d));
  });
  return cells;
}

// state: dimension, change, whether by the script.
void change(benchmark::State& state) {
  const auto dimension = static_cast<int>(state.range(0));
  const Pair& pair = pairs[static_cast<std::size_t>(state.range(1))];
  const ChangeType& function = *find_change(pair.function);
  const char* const name = pair.script[static_cast<std::size_t>(dimension - 2)];
  const auto script = change_by(*find_house_rule_or_script(name), dimension);
  const ChangeType& type = state.range(2) == 0 ? function : *script;
  state.SetLabel(type.name);
  std::size_t made = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const auto body = body_of(dimension);
    const auto cells = some_cells(body->map->map(), orbit_of(function.cell, dimension));
    const ForceView view = body->view();
    std::vector<Dart> left;
    state.ResumeTiming();
    body->map->edit([&](Edit& edit) {
      for (const std::vector<Dart>& cell : cells) {
        left.clear();
        for (Dart d : cell)
          if (edit.map().alive(d)) left.push_back(d);
        if (!left.empty()) made += type.apply(edit, view, Vec3(0.6, 0.64, 0.48), left);
      }
    });
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(made));
}
BENCHMARK(change)
    ->ArgNames({"dimension", "change", "script"})
    ->ArgsProduct({{2, 3}, {0, 1, 2, 3}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace rend
