// The counterpart of map_bench.cpp: CGAL's generalized map, with a point as the only attribute of its vertices,
// on the same blocks. Built if the library is installed (libcgal-dev); contains no code of rend.
#include <CGAL/Linear_cell_complex_for_generalized_map.h>
#include <CGAL/Linear_cell_complex_traits.h>
#include <CGAL/Simple_cartesian.h>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace {

using Traits = CGAL::Linear_cell_complex_traits<3, CGAL::Simple_cartesian<double>>;
using Complex = CGAL::Linear_cell_complex_for_generalized_map<3, 3, Traits>;
using Handle = Complex::Dart_handle;
using Point = Complex::Point;
using Sides = std::vector<std::pair<Handle, Handle>>; // darts by which inner faces will be sewn

using Box = std::array<Point, 8>; // corners in Gmsh's order

void add_tetrahedra(Complex& map, const Box& b) { // splits a box as sim/mesh/bar.cpp does
  constexpr std::array<std::array<std::size_t, 2>, 6> paths{{{1, 2}, {3, 2}, {1, 5}, {4, 5}, {3, 7}, {4, 7}}};
  for (const auto& [p, q] : paths) map.make_tetrahedron(b[0], b[p], b[q], b[6]);
}

void add_cells(Complex& map, bool tetrahedra) {
  const int n = tetrahedra ? 15 : 20;
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const Box b{
            Point(x, y, z),     Point(x + 1, y, z),     Point(x + 1, y + 1, z),     Point(x, y + 1, z),
            Point(x, y, z + 1), Point(x + 1, y, z + 1), Point(x + 1, y + 1, z + 1), Point(x, y + 1, z + 1)};
        if (tetrahedra)
          add_tetrahedra(map, b);
        else
          map.make_hexahedron(b[0], b[1], b[2], b[3], b[7], b[4], b[5], b[6]);
      }
}

// Pairs of faces with the same corners, each given by the dart at its smallest corner that points to the
// smaller neighbour of that.
Sides matching_sides(Complex& map) {
  std::map<std::array<Point, 3>, Handle> open;
  Sides sides;
  for (auto d = map.darts().begin(); d != map.darts().end(); ++d) {
    const Point from = map.point(d), to = map.point(map.alpha(d, 0)), other = map.point(map.alpha(d, 1, 0));
    bool canonical = to < other;
    for (auto e = map.darts_of_orbit<0, 1>(d).begin(); e.cont(); ++e)
      canonical = canonical && from <= map.point(e);
    if (!canonical) continue;
    const auto [place, first] = open.insert({{from, to, other}, d});
    if (!first) sides.push_back({place->second, d});
  }
  return sides;
}

struct Block {
  Complex map;
  Sides sides;
  explicit Block(bool tetrahedra) {
    add_cells(map, tetrahedra);
    sides = matching_sides(map);
    for (const auto& [a, b] : sides) map.sew<3>(a, b);
  }
};

template <unsigned cell> void walk_all(benchmark::State& state, bool tetrahedra) {
  Block block(tetrahedra);
  std::vector<Handle> firsts;
  auto cells = block.map.one_dart_per_cell<cell>();
  for (auto d = cells.begin(); d != cells.end(); ++d) firsts.push_back(d);
  for (auto _ : state) {
    for (const Handle first : firsts)
      for (auto d = block.map.darts_of_cell<cell>(first).begin(); d.cont(); ++d)
        benchmark::DoNotOptimize(static_cast<Handle>(d));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(block.map.number_of_darts()));
}
void walk_vertices(benchmark::State& state, bool tetrahedra) {
  walk_all<0>(state, tetrahedra);
}
void walk_edges(benchmark::State& state, bool tetrahedra) {
  walk_all<1>(state, tetrahedra);
}
BENCHMARK_CAPTURE(walk_vertices, hexahedra, false)->Name("figure/vertex_orbit_hexahedra_cgal");
BENCHMARK_CAPTURE(walk_vertices, tetrahedra, true)->Name("figure/vertex_orbit_tetrahedra_cgal");
BENCHMARK_CAPTURE(walk_edges, hexahedra, false)->Name("figure/edge_orbit_hexahedra_cgal");
BENCHMARK_CAPTURE(walk_edges, tetrahedra, true)->Name("figure/edge_orbit_tetrahedra_cgal");

// The pairs of faces are computed beforehand, outside of the measured time: CGAL offers no function for that.
void build_and_sew(benchmark::State& state) {
  std::int64_t darts = 0;
  for (auto _ : state) {
    auto map = std::make_unique<Complex>();
    add_cells(*map, false);
    state.PauseTiming();
    const Sides sides = matching_sides(*map);
    state.ResumeTiming();
    for (const auto& [a, b] : sides) map->sew<3>(a, b);
    state.PauseTiming();
    darts += static_cast<std::int64_t>(map->number_of_darts());
    map.reset();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(darts);
}
BENCHMARK(build_and_sew)->Name("figure/build_and_sew_hexahedra_cgal")->Unit(benchmark::kMillisecond);

// together: links first, then all attributes at once (CGAL's way to make many changes).
void unsew_faces(benchmark::State& state, bool together) {
  std::int64_t faces = 0;
  for (auto _ : state) {
    state.PauseTiming();
    auto block = std::make_unique<Block>(false);
    faces += static_cast<std::int64_t>(block->sides.size());
    state.ResumeTiming();
    if (together) block->map.set_automatic_attributes_management(false);
    for (const auto& [a, b] : block->sides) block->map.unsew<3>(a);
    if (together) block->map.set_automatic_attributes_management(true);
    state.PauseTiming();
    block.reset();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(faces);
}
BENCHMARK_CAPTURE(unsew_faces, together, true)
    ->Name("figure/unsew3_all_faces_cgal")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(unsew_faces, single, false)
    ->Name("figure/unsew3_one_face_cgal")
    ->Unit(benchmark::kMillisecond);

// Links and points only: no rest state, velocity or element.
void bytes_of_tetrahedra(benchmark::State& state, std::size_t n) {
  Block block(true);
  for (auto _ : state)
    for (std::size_t f = 0; n > 0 && f < block.sides.size(); f += n) block.map.unsew<3>(block.sides[f].first);
  state.counters["bytes_per_dart"] =
      static_cast<double>(block.map.bytes()) / static_cast<double>(block.map.number_of_darts());
}
BENCHMARK_CAPTURE(bytes_of_tetrahedra, whole, 0)->Name("figure/map_bytes_whole_cgal")->Iterations(1);
BENCHMARK_CAPTURE(bytes_of_tetrahedra, torn, 3)->Name("figure/map_bytes_torn_cgal")->Iterations(1);
BENCHMARK_CAPTURE(bytes_of_tetrahedra, apart, 1)->Name("figure/map_bytes_all_apart_cgal")->Iterations(1);

} // namespace
