// Springs, elements and threads: the table in the README. Everything is deformed, each row differently.
#include "bench/per_element.h"
#include "bench/plain_cloth.h"
#include "sim/elements.h"
#include "sim/presets.h"

namespace rend {
namespace {

using namespace elements;

const char* const small_steps = R"(<time step="1e-6" integrator="symplectic" duration="1"/>)";

// cells x cells quads with stretch, shear and bend: about six springs per quad. Vertices are displaced by up to
// 2 % of a quad.
presets::Loaded shaken_cloth(int cells, int threads = 1) {
  presets::Loaded scene = presets::load(presets::cloth("quads", cells, "", small_steps), {.threads = threads});
  meshes::Noise noise(1);
  for (Record& x : scene.body().map->position().values()) x = Record(x.vec() + 0.02 / cells * noise.vector());
  return scene;
}

double springs_of(const Body& body) {
  std::size_t rows = 0;
  for (const Binder& binder : body.program->folded()) rows += binder.rows().live_count();
  return static_cast<double>(rows);
}

void spring_steps(benchmark::State& state, int cells, int threads) {
  const presets::Loaded scene = shaken_cloth(cells, threads);
  for (int n = 0; n < 20; ++n) scene->step();
  for (auto _ : state) scene->step();
  count_elements(state, springs_of(scene.body()));
}
BENCHMARK_CAPTURE(spring_steps, 64, 64, 1)->Name("figure/springs_64");
BENCHMARK_CAPTURE(spring_steps, 41, 41, 1)->Name("figure/springs_10000");
BENCHMARK_CAPTURE(spring_steps, 408, 408, 1)->Name("figure/springs_1000000");
BENCHMARK_CAPTURE(spring_steps, one, 128, 1)->Name("figure/threads_springs_1")->UseRealTime();
BENCHMARK_CAPTURE(spring_steps, two, 128, 2)->Name("figure/threads_springs_2")->UseRealTime();

void plain_steps(benchmark::State& state) {
  PlainCloth cloth(shaken_cloth(64).body());
  for (int n = 0; n < 20; ++n) cloth.step(1e-6);
  for (auto _ : state) cloth.step(1e-6);
  count_elements(state, static_cast<double>(cloth.k.size()));
}
BENCHMARK(plain_steps)->Name("figure/springs_64_plain");

void quads_rk4(benchmark::State& state) {
  const presets::Loaded scene = presets::load(presets::cloth("quads", 10));
  for (int n = 0; n < 200; ++n) scene->step();
  for (auto _ : state) scene->step();
  count_elements(state, springs_of(scene.body()));
}
BENCHMARK(quads_rk4)->Name("figure/quads_10_rk4");

// As many elements as the argument, up to a few per cent more, warped at rest and displaced by 5 % of their
// size.
void element_forces(benchmark::State& state, BarPattern pattern, const Elastic& recipe) {
  const int each = pattern == BarPattern::Tetrahedra ? 6 : 1, side = state.range(0) > 100000 ? 60 : 10;
  const int length = static_cast<int>(state.range(0)) / (each * side * side) + 1;
  const auto body = elastic_body(solid_from(warped_bar(pattern, length, side, side, 0.1, 1)), recipe);
  meshes::shake(*body, 0.05, 2);
  std::vector<Record> force(body->program->vertices());
  for (auto _ : state) body->program->forces(meshes::positions(*body), meshes::velocities(*body), force.data());
  count_elements(state, static_cast<double>(body->map->cells(Volume).count()));
}
const Elastic polar{"corotational"}, qr{"corotational", "qr"};
BENCHMARK_CAPTURE(element_forces, polar, BarPattern::Tetrahedra, polar)
    ->Name("figure/tetrahedron_polar")
    ->Arg(10000)
    ->Arg(20000)
    ->Arg(1000000);
BENCHMARK_CAPTURE(element_forces, qr, BarPattern::Tetrahedra, qr)
    ->Name("figure/tetrahedron_qr")
    ->Arg(10000)
    ->Arg(20000)
    ->Arg(1000000);
BENCHMARK_CAPTURE(element_forces, hexahedra, BarPattern::Hexahedra, polar)
    ->Name("figure/hexahedron_polar")
    ->Arg(10000);

void tetrahedron_steps(benchmark::State& state, int threads) {
  const presets::Loaded scene = presets::load(
      R"(<scene name="bar"><body name="bar"><bar pattern="tetrahedra" cells="100 10 10" size="1 0.1 0.1"/>)"
      R"(<mass total="10"/><elasticity young="1e5" poisson="0.3"/><fix side="-x"/></body>)"
      R"(<time step="1e-6" integrator="symplectic" duration="1"/></scene>)",
      {.threads = threads});
  meshes::Noise noise(1);
  for (Record& x : scene.body().map->position().values()) x = Record(x.vec() + 0.0003 * noise.vector());
  for (int n = 0; n < 20; ++n) scene->step();
  for (auto _ : state) scene->step();
  count_elements(state, static_cast<double>(scene.body().map->cells(Volume).count()));
}
BENCHMARK_CAPTURE(tetrahedron_steps, one, 1)->Name("figure/threads_tetrahedra_1")->UseRealTime();
BENCHMARK_CAPTURE(tetrahedron_steps, two, 2)->Name("figure/threads_tetrahedra_2")->UseRealTime();

} // namespace
} // namespace rend
