// Reading and sewing about 1,000,000 tetrahedra: the target is at most 10 s and 64 bytes a dart.
#include "sim/mechanics/mass.h"
#include "sim/mesh/bar.h"
#include "sim/mesh/msh_writer.h"

#include <benchmark/benchmark.h>

namespace rend {
namespace {

const std::string& bar_file() { // 55 x 55 x 55 boxes, of six tetrahedra each: 998,250
  static const std::string text = [] {
    MeshBody body;
    body.map = solid_from(bar_cells({BarPattern::Tetrahedra, 55, 55, 55, Vec3(1, 1, 1)}));
    return msh_text(body, "bar.msh");
  }();
  return text;
}

void read_a_million_tetrahedra(benchmark::State& state) {
  const std::string& text = bar_file();
  for (auto _ : state) benchmark::DoNotOptimize(read_mesh(MeshSource("bar.msh", text)));
}
BENCHMARK(read_a_million_tetrahedra)->Unit(benchmark::kSecond)->Iterations(1);

void read_and_sew_a_million_tetrahedra(benchmark::State& state) {
  const std::string& text = bar_file();
  for (auto _ : state) {
    const MeshBody body = sew(read_mesh(MeshSource("bar.msh", text)));
    const auto darts = static_cast<double>(body.map->map().dart_count());
    state.counters["bytes/dart"] = static_cast<double>(body.map->map().bytes() + body.map->bytes()) / darts;
  }
}
BENCHMARK(read_and_sew_a_million_tetrahedra)->Unit(benchmark::kSecond)->Iterations(1);

} // namespace
} // namespace rend
