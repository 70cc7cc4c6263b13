// Benchmarks of the map: walks, construction, separations and bytes, on blocks of 20 × 20 × 20 hexahedra
// (384,000 darts) and of 6 × 15³ tetrahedra (486,000). cgal_bench.cpp does the same with CGAL's generalized
// map, if it is installed.
#include "bench/walk_orbits.h"
#include "sim/elements.h"

#include <benchmark/benchmark.h>

#include <memory>

namespace rend {
namespace {

std::unique_ptr<EmbeddedMap> block(bool tetrahedra) {
  const int n = tetrahedra ? 15 : 20;
  return solid_from(
      bar_cells({tetrahedra ? BarPattern::Tetrahedra : BarPattern::Hexahedra, n, n, n, Vec3(1, 1, 1)}));
}

void walk_all(benchmark::State& state, Orbit orbit, bool tetrahedra) {
  const std::unique_ptr<EmbeddedMap> body = block(tetrahedra);
  walk_orbits(state, body->map(), orbit);
}
BENCHMARK_CAPTURE(walk_all, vertex_hexahedra, Vertex, false)->Name("figure/vertex_orbit_hexahedra");
BENCHMARK_CAPTURE(walk_all, vertex_tetrahedra, Vertex, true)->Name("figure/vertex_orbit_tetrahedra");
BENCHMARK_CAPTURE(walk_all, edge_hexahedra, Edge, false)->Name("figure/edge_orbit_hexahedra");
BENCHMARK_CAPTURE(walk_all, edge_tetrahedra, Edge, true)->Name("figure/edge_orbit_tetrahedra");

// From points and cells to a map with its vertices and three columns on them; an item is a dart.
void build_and_sew(benchmark::State& state) {
  const CellMesh cells = bar_cells({BarPattern::Hexahedra, 20, 20, 20, Vec3(1, 1, 1)});
  std::int64_t darts = 0;
  for (auto _ : state) {
    const std::unique_ptr<EmbeddedMap> body = solid_from(cells);
    darts += static_cast<std::int64_t>(body->map().dart_count());
  }
  state.SetItemsProcessed(darts);
}
BENCHMARK(build_and_sew)->Name("figure/build_and_sew_hexahedra")->Unit(benchmark::kMillisecond);

std::vector<Dart> inner_faces(const GMap& map) {
  const CellIndex faces(map, Face);
  std::vector<Dart> inner;
  for (Slot f = 0; f < faces.slots(); ++f)
    if (!map.is_free(3, faces.first_dart(f))) inner.push_back(faces.first_dart(f));
  return inner;
}

// All inner faces, with vertices split; an item is a face.
void unsew_faces(benchmark::State& state, bool together) {
  std::int64_t faces = 0;
  for (auto _ : state) {
    state.PauseTiming();
    std::unique_ptr<EmbeddedMap> body = block(false);
    body->reserve_for_separations();
    const std::vector<Dart> inner = inner_faces(body->map());
    faces += static_cast<std::int64_t>(inner.size());
    state.ResumeTiming();
    if (together)
      body->edit([&](Edit& edit) {
        for (Dart d : inner) unsew(edit, 3, d);
      });
    else
      for (Dart d : inner) body->edit([&](Edit& edit) { unsew(edit, 3, d); });
    state.PauseTiming();
    body.reset();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(faces);
}
BENCHMARK_CAPTURE(unsew_faces, together, true)->Name("figure/unsew3_all_faces")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(unsew_faces, single, false)->Name("figure/unsew3_one_face")->Unit(benchmark::kMillisecond);

// Map, slots and columns of co-rotational tetrahedra that can tear, with every `n`-th inner face separated (0:
// none).
void bytes_of_tetrahedra(benchmark::State& state, std::size_t n) {
  const std::unique_ptr<Body> body = elements::elastic_body(block(true), {});
  body->border = &body->map->add(InitialBorder(3));
  const std::vector<Dart> inner = inner_faces(body->map->map());
  for (auto _ : state)
    body->map->edit([&](Edit& edit) {
      for (std::size_t f = 0; n > 0 && f < inner.size(); f += n) unsew(edit, 3, inner[f]);
    });
  const GMap& map = body->map->map();
  const auto darts = static_cast<double>(map.dart_count());
  state.counters["bytes_per_dart"] = static_cast<double>(map.bytes() + body->map->bytes()) / darts;
  state.counters["vertices"] = static_cast<double>(body->map->cells(Vertex).count());
}
BENCHMARK_CAPTURE(bytes_of_tetrahedra, whole, 0)->Name("figure/map_bytes_whole")->Iterations(1);
BENCHMARK_CAPTURE(bytes_of_tetrahedra, torn, 3)->Name("figure/map_bytes_torn")->Iterations(1);
BENCHMARK_CAPTURE(bytes_of_tetrahedra, dust, 1)->Name("figure/map_bytes_all_apart")->Iterations(1);

} // namespace
} // namespace rend
