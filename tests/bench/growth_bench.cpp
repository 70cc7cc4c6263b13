// Elements that are born one after another in a large solid, with all that follows but the forces: the rule,
// the closing of the edit, and the rows of the body. All tetrahedra around an edge are halved at a time, in
// an edit of its own.
#include "sim/elements.h"
#include "sim/fracture/rule_change.h"
#include "sim/house_rules/house_scripts.h"
#include "sim/mesh/bar.h"
#include "sim/mesh/cells.h"
#include "sim/rules/apply.h"
#include "sim/topology/walk.h"

#include <benchmark/benchmark.h>

#include <ctime>
#include <memory>
#include <random>

namespace rend {
namespace {

// n × n × n cells of six tetrahedra; with a law or without, which decides whether room is reserved.
std::unique_ptr<Body> solid(int n, bool room) {
  auto body = std::make_unique<Body>();
  body->map = solid_from(bar_cells({BarPattern::Tetrahedra, n, n, n, Vec3(1, 1, 1)}));
  CornerMass mass;
  mass.density = 1000;
  body->mass = &body->map->add(mass.on(*body->map));
  elements::add_elasticity(*body, {});
  body->border = &body->map->add(InitialBorder(3));
  if (room) {
    LawSettings law{.criterion = find_criterion("atomic-element"), .threshold = 1e30, .cell = Cell::Elements};
    law.change = find_change("delete-element");
    body->tear_laws.emplace_back(body->request_for(law), law);
    body->map->let_grow();
  }
  body->prepare(*find_scheme("symplectic"));
  return body;
}

// [s], of this thread: other programs of the machine do not count.
double seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}
double seconds_of(auto&& what) {
  const double start = seconds();
  what();
  return seconds() - start;
}

// One dart of each of some edges, far from each other.
std::vector<Dart> some_edges(const GMap& map, std::size_t count) {
  std::mt19937 random(7);
  std::vector<Dart> darts;
  while (darts.size() < count) darts.push_back(Dart{random() % map.capacity()});
  return darts;
}

// state: cells on a side; whether room is reserved. Counters: the first birth [ms]; of all later ones,
// microseconds a new element, and the longest single change [ms].
void birth(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  for (auto _ : state) {
    const auto body = solid(n, state.range(1) != 0);
    const GMap& map = body->map->map();
    RuleRunner halve(*find_house_rule_or_script("halve-tetrahedra")->rule);
    halve.context().most_darts = 2 * map.capacity(); // a million tetrahedra are beyond the budget of rules
    double first = 0, longest = 0, edits = 0, rows = 0;
    std::size_t darts = 0;
    for (Dart d : some_edges(map, 400)) {
      const std::size_t before = map.dart_count();
      double edit = seconds_of([&] { body->map->edit([&](Edit& open) { halve.apply(open, d); }); });
      double rest = seconds_of([&] { body->rebind(); });
      if (map.dart_count() == before) continue;
      if (first == 0) {
        first = edit + rest;
        continue;
      }
      longest = std::max(longest, edit + rest);
      edits += edit;
      rows += rest;
      darts += map.dart_count() - before;
    }
    const double born = static_cast<double>(darts) / 24;
    state.SetIterationTime(edits + rows);
    state.counters["tetrahedra"] = static_cast<double>(map.dart_count()) / 24;
    state.counters["first_ms"] = 1e3 * first;
    state.counters["longest_ms"] = 1e3 * longest;
    state.counters["us_an_element"] = 1e6 * (edits + rows) / born;
    state.counters["us_edit"] = 1e6 * edits / born;
    state.counters["us_rows"] = 1e6 * rows / born;
  }
}
BENCHMARK(birth)
    ->ArgNames({"cells", "room"})
    ->ArgsProduct({{10, 25, 55}, {0, 1}})
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace rend
