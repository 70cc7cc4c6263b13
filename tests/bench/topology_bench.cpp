// The cost of a walk, a separation and a subdivision. Build with cmake -DREND_BENCH=ON, and run topology_bench.
#include "bench/walk_orbits.h"
#include "sim/base/archive.h"
#include "sim/boundary/solid_surface.h"
#include "sim/elements.h"
#include "sim/house_rules/house_rules.h"
#include "sim/mesh/sheet.h"
#include "sim/rules/apply.h"
#include "sim/topology/walk.h"

#include <benchmark/benchmark.h>

#include <memory>
#include <random>

namespace rend {
namespace {

// n × n quads of 8 darts, row by row, built in bulk. Dart 8q + 2s + e: end e of side s (south, east, north,
// west).
GMap quads(std::uint32_t n) {
  GMap map(2);
  MapEdit edit(map);
  edit.reserve(8ull * n * n);
  const auto dart = [&](std::uint32_t x, std::uint32_t y, std::uint32_t k) {
    return Dart{8 * (y * n + x) + k};
  };
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      for (int k = 0; k < 8; ++k) edit.add_dart();
      for (std::uint32_t k = 0; k < 8; ++k)
        edit.link(k % 2 == 0 ? 0 : 1, dart(x, y, k), dart(x, y, (k + 1) % 8));
      if (y > 0) {
        edit.link(2, dart(x, y, 0), dart(x, y - 1, 5));
        edit.link(2, dart(x, y, 1), dart(x, y - 1, 4));
      }
      if (x > 0) {
        edit.link(2, dart(x, y, 7), dart(x - 1, y, 2));
        edit.link(2, dart(x, y, 6), dart(x - 1, y, 3));
      }
    }
  }
  return map;
}

std::unique_ptr<EmbeddedMap> sheet(std::uint32_t n) {
  return std::make_unique<EmbeddedMap>(quads(n), [](Dart d) {
    const Vec3 place(d.value % 1000, d.value / 1000, 0);
    return Point{place, place, Vec3::Zero()};
  });
}

std::vector<Dart> one_dart_per_vertex(const GMap& map, bool shuffled) {
  const CellIndex cells(map, Vertex);
  std::vector<Dart> darts;
  for (Slot s = 0; s < cells.slots(); ++s) darts.push_back(cells.first_dart(s));
  if (shuffled) std::shuffle(darts.begin(), darts.end(), std::mt19937(1));
  return darts;
}

void walk_vertices(benchmark::State& state) {
  const GMap map = quads(static_cast<std::uint32_t>(state.range(0)));
  const std::vector<Dart> firsts = one_dart_per_vertex(map, state.range(1) != 0);
  for (auto _ : state) {
    std::uint32_t sum = 0;
    for (Dart d : firsts) walk_sheet_vertex(map, d, [&](Dart e) { sum += e.value; });
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(map.dart_count()));
}
BENCHMARK(walk_vertices)->ArgNames({"side", "shuffled"})->Args({50, 0})->Args({1000, 0})->Args({1000, 1});

void collect_orbits(benchmark::State& state) {
  const GMap map = quads(100);
  Orbit orbit;
  orbit.mask = static_cast<std::uint8_t>(state.range(0));
  state.SetLabel(name(orbit));
  walk_orbits(state, map, orbit);
}
BENCHMARK(collect_orbits)->Arg(Vertex.mask)->Arg(Edge.mask)->Arg(FaceOfVolume.mask)->Arg(Component.mask);

// The east edges of every second column, bottom to top: each one but the first of a column splits at least one
// vertex.
std::vector<Dart> columns_of_edges(std::uint32_t n) {
  std::vector<Dart> edges;
  for (std::uint32_t x = 0; x + 1 < n; x += 2)
    for (std::uint32_t y = 0; y < n; ++y) edges.push_back(Dart{8 * (y * n + x) + 2});
  return edges;
}

enum Way { Single, ByRule, Together, TogetherByRule };

// The vertices and one more column besides the points; per edge. state: side of the sheet, variant.
void unsew_edges(benchmark::State& state) {
  const auto n = static_cast<std::uint32_t>(state.range(0));
  const std::vector<Dart> edges = columns_of_edges(n);
  for (auto _ : state) {
    state.PauseTiming();
    auto body = sheet(n);
    body->add(VertexRecord{"another"});
    state.ResumeTiming();
    if (state.range(1) == Single)
      for (Dart d : edges) body->edit([&](Edit& edit) { unsew(edit, 2, d); });
    RuleRunner runner(rule("unsew-edge"));
    if (state.range(1) == ByRule)
      for (Dart d : edges) body->edit([&](Edit& edit) { runner.apply(edit, d); });
    if (state.range(1) == Together)
      body->edit([&](Edit& edit) {
        for (Dart d : edges) unsew(edit, 2, d);
      });
    if (state.range(1) == TogetherByRule)
      body->edit([&](Edit& edit) {
        for (Dart d : edges) runner.apply(edit, d);
      });
    state.PauseTiming();
    body.reset();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(edges.size()));
}
BENCHMARK(unsew_edges)
    ->ArgNames({"side", "way"})
    ->Args({50, Single})
    ->Args({50, ByRule})
    ->Args({50, Together})
    ->Args({50, TogetherByRule})
    ->Args({300, Single})
    ->Args({300, ByRule})
    ->Args({300, Together})
    ->Args({300, TogetherByRule});

// A rule that does not match: of two faces at an edge of the border, there is one. Per edge.
void no_match(benchmark::State& state) {
  const auto n = static_cast<std::uint32_t>(state.range(0));
  const auto body = sheet(n);
  std::vector<Dart> edges;
  for (std::uint32_t x = 0; x < n; ++x) edges.push_back(Dart{8 * x}); // the south sides of the first row
  body->edit([&](Edit& edit) {
    RuleRunner runner(rule("unsew-edge"));
    for (auto _ : state)
      for (Dart d : edges)
        if (runner.apply(edit, d)) state.SkipWithError("it matches");
  });
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(edges.size()));
}
BENCHMARK(no_match)->ArgName("side")->Arg(50);

SheetShape square(std::int64_t n) {
  SheetShape shape;
  shape.pattern = SheetPattern::Quads;
  shape.nx = shape.ny = static_cast<int>(n);
  shape.size = {1, 1};
  return shape;
}

// A sheet of n × n quads to one of 2n × 2n: subdivided by the rule, or built in bulk. Per dart of the result.
void subdivide_sheet(benchmark::State& state) {
  const std::int64_t n = state.range(0);
  const PolygonMesh mesh = sheet_polygons(square(n));
  RuleRunner runner(rule("quarter-faces"));
  for (auto _ : state) {
    state.PauseTiming();
    auto body = sheet_from(mesh);
    state.ResumeTiming();
    body->edit([&](Edit& edit) { runner.apply(edit, Dart{0u}); });
    state.PauseTiming();
    if (body->map().dart_count() != static_cast<std::size_t>(32 * n * n))
      state.SkipWithError("it does not match");
    body.reset();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * 32 * n * n);
}
BENCHMARK(subdivide_sheet)->ArgName("side")->Arg(112)->Arg(1000)->Unit(benchmark::kMillisecond);

void build_subdivided(benchmark::State& state) {
  const std::int64_t n = state.range(0);
  const PolygonMesh mesh = sheet_polygons(square(2 * n));
  for (auto _ : state) {
    auto body = sheet_from(mesh);
    state.PauseTiming();
    body.reset();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * 32 * n * n);
}
BENCHMARK(build_subdivided)->ArgName("side")->Arg(112)->Arg(1000)->Unit(benchmark::kMillisecond);

// A cube of 6 n³ co-rotational tetrahedra that tears, and its surface.
struct TornCube {
  std::unique_ptr<Body> body;
  std::unique_ptr<SolidSurface> surface;
  std::vector<Dart> cracks; // faces normal to x, plane after plane, row by row: as a crack grows

  explicit TornCube(int n) : body(elements::elastic_body(cube(n), {})) {
    body->border = &body->map->add(InitialBorder(3));
    body->map->subscribe(body->changes);
    body->map->reserve_for_separations();
    body->program->reserve_for_separations();
    surface = std::make_unique<SolidSurface>(*body->map, body->border);
    find_cracks();
  }

  static std::unique_ptr<EmbeddedMap> cube(int n) {
    return solid_from(bar_cells({BarPattern::Tetrahedra, n, n, n, Vec3(n, n, n)}));
  }

  void find_cracks() {
    const GMap& map = body->map->map();
    std::vector<std::pair<std::array<double, 3>, Dart>> faces;
    map.for_each_dart([&](Dart d) {
      if (map.is_free(3, d) || smallest_dart(map, Face, d) != d) return;
      const Vec3 a = body->map->rest_of(d), b = body->map->rest_of(map.alpha(0, d)),
                 c = body->map->rest_of(map.follow(d, std::string_view("101"))), sum = a + b + c;
      if (a.x() == b.x() && b.x() == c.x()) faces.push_back({{sum.x(), sum.z(), sum.y()}, d});
    });
    std::sort(faces.begin(), faces.end());
    for (const auto& [place, d] : faces) cracks.push_back(d);
  }

  void follow() {
    body->rebind();
    surface->update();
  }
};

// One after another, with all that depends on them: embeddings, program, surface.
void separate_tetrahedra(benchmark::State& state) {
  TornCube cube(static_cast<int>(state.range(0)));
  std::size_t next = 0;
  for (auto _ : state) {
    cube.body->map->edit([&](Edit& edit) { unsew(edit, 3, cube.cracks[next]); });
    cube.follow();
    ++next;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(separate_tetrahedra)
    ->ArgName("boxes")
    ->Arg(12)
    ->Arg(55)
    ->Iterations(3000)
    ->Unit(benchmark::kMicrosecond);

// Every face of 50,000 tetrahedra in one step.
void storm(benchmark::State& state) {
  TornCube cube(20);
  const double mass = total_mass(*cube.body->map, *cube.body->mass);
  for (auto _ : state) {
    cube.body->map->edit([&](Edit& edit) { edit.map().for_each_dart([&](Dart d) { unsew(edit, 3, d); }); });
    cube.follow();
  }
  if (validate(*cube.body->map) || total_mass(*cube.body->map, *cube.body->mass) != mass)
    state.SkipWithError("the map or the mass is wrong");
}
BENCHMARK(storm)->Iterations(1)->Unit(benchmark::kMillisecond);

// Separates a third of the faces, at random places and a few at a time; then renumbers slots in the order of
// darts (embedding/reorder.h), optionally with all that depends on the map. state: boxes, whether dependents
// are updated.
void number_anew(benchmark::State& state) {
  TornCube cube(static_cast<int>(state.range(0)));
  EmbeddedMap& map = *cube.body->map;
  std::vector<Dart> faces;
  map.map().for_each_dart([&](Dart d) {
    if (!map.map().is_free(3, d) && smallest_dart(map.map(), Face, d) == d) faces.push_back(d);
  });
  std::shuffle(faces.begin(), faces.end(), std::mt19937(1));
  faces.resize(faces.size() / 3);
  for (std::size_t n = 0; n < faces.size(); n += 200)
    map.edit([&](Edit& edit) {
      for (std::size_t f = n; f < std::min(n + 200, faces.size()); ++f) unsew(edit, 3, faces[f]);
    });
  Archive torn;
  map.store(torn);
  for (auto _ : state) {
    state.PauseTiming();
    Archive again{std::span<const std::uint8_t>(torn.bytes())};
    map.store(again);
    cube.follow();
    state.ResumeTiming();
    map.renumber();
    if (state.range(1) != 0) cube.follow();
  }
  state.counters["vertices"] = static_cast<double>(map.cells(Vertex).count());
}
BENCHMARK(number_anew)
    ->ArgNames({"boxes", "followed"})
    ->Args({32, 0})
    ->Args({32, 1})
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace rend
