// The cloth of the thesis's table 7.1: steps, criteria, flat arrays against walking the map, and a plain loop
// over the same springs.
#include "bench/plain_cloth.h"
#include "sim/boundary/surface.h"
#include "sim/presets.h"
#include "sim/topology/count.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <sys/resource.h>

namespace rend {
namespace {

const char* const global_law = R"(<tear criterion="global-border" threshold="1e9"/>)";
const char* const atomic_law = R"(<tear criterion="atomic-border" threshold="1e9"/>)";

void steps(benchmark::State& state, const std::string& xml, const SceneOptions& options = {}) {
  presets::Loaded scene = presets::load(xml, options);
  for (int n = 0; n < 200; ++n) scene->step();
  for (auto _ : state) scene->step();
  std::size_t rows = 0;
  for (const Binder& binder : scene.body().program->folded()) rows += binder.rows().live_count();
  state.counters["springs"] = static_cast<double>(rows);
}

void rk4_step(benchmark::State& state, const std::string& pattern, const std::string& law) {
  steps(state, presets::cloth(pattern, 10, law));
}
BENCHMARK_CAPTURE(rk4_step, quads, "quads", "");
BENCHMARK_CAPTURE(rk4_step, quads_global, "quads", global_law);
BENCHMARK_CAPTURE(rk4_step, quads_atomic, "quads", atomic_law);
BENCHMARK_CAPTURE(rk4_step, crossed, "crossed", "");
BENCHMARK_CAPTURE(rk4_step, crossed_global, "crossed", global_law);
BENCHMARK_CAPTURE(rk4_step, crossed_atomic, "crossed", atomic_law);
BENCHMARK_CAPTURE(rk4_step, mixed, "mixed", "");
BENCHMARK_CAPTURE(rk4_step, mixed_global, "mixed", global_law);
BENCHMARK_CAPTURE(rk4_step, mixed_atomic, "mixed", atomic_law);

// A step of 100 x 100 quads that are stretched by 2 %, and what a tearing law adds to it. far: all values are
// far below the threshold; near: half of it, everywhere.
void criterion_step(benchmark::State& state, const std::string& attributes, bool near) {
  const auto cloth = [&](double threshold) {
    const std::string law =
        attributes.empty() ? "" : fmt::format("<tear {} threshold=\"{}\"/>", attributes, threshold);
    presets::Loaded scene = presets::load(
        presets::cloth("quads", 100, law, R"(<time step="1e-7" integrator="rk4" duration="1"/>)"));
    for (Record& x : scene.body().map->position().values()) x = Record(1.02 * x.vec());
    for (int n = 0; n < 20; ++n) scene->step();
    return scene;
  };
  double threshold = 1e9;
  if (near) {
    const presets::Loaded scene = cloth(threshold);
    Body& body = scene.body();
    body.evaluate();
    LawSettings settings = body.tear_laws.front().settings();
    settings.threshold = 1e-12;
    TearLaw all(body.request_for(settings), settings);
    threshold = 2 * all.find(body.view()).front().value;
  }
  presets::Loaded scene = cloth(threshold);
  for (auto _ : state) scene->step();
  state.counters["torn"] = static_cast<double>(scene->tears());
}
BENCHMARK_CAPTURE(criterion_step, none, "", false);
BENCHMARK_CAPTURE(criterion_step, global, R"(criterion="global-border")", false);
BENCHMARK_CAPTURE(criterion_step, global_near, R"(criterion="global-border")", true);
BENCHMARK_CAPTURE(criterion_step, atomic, R"(criterion="atomic-border")", false);
BENCHMARK_CAPTURE(criterion_step, atomic_near, R"(criterion="atomic-border")", true);
BENCHMARK_CAPTURE(criterion_step, spring, R"(criterion="atomic-spring" kind="stretch" change="separate")",
                  false);
BENCHMARK_CAPTURE(criterion_step, spring_near, R"(criterion="atomic-spring" kind="stretch" change="separate")",
                  true);
BENCHMARK_CAPTURE(criterion_step, strain, R"(criterion="strain" kind="stretch" change="separate")", false);

const char* const small_steps = R"(<time step="1e-6" integrator="symplectic" duration="1"/>)";

void flat(benchmark::State& state) {
  steps(state, presets::cloth("quads", static_cast<int>(state.range(0)), "", small_steps));
}
BENCHMARK(flat)->Arg(10)->Arg(64)->Arg(100)->Arg(1000);

void walk(benchmark::State& state) {
  steps(state, presets::cloth("quads", static_cast<int>(state.range(0)), "", small_steps),
        {.walk = true, .threads = 1});
}
BENCHMARK(walk)->Arg(10)->Arg(100);

void plain_loop(benchmark::State& state) {
  PlainCloth cloth([&] {
    const presets::Loaded scene =
        presets::load(presets::cloth("quads", static_cast<int>(state.range(0)), "", small_steps));
    return PlainCloth(scene.body());
  }());
  for (int n = 0; n < 200; ++n) cloth.step(1e-6);
  for (auto _ : state) cloth.step(1e-6);
  state.counters["springs"] = static_cast<double>(cloth.k.size());
}
BENCHMARK(plain_loop)->Arg(10)->Arg(64)->Arg(100)->Arg(1000);

void build_and_bind(benchmark::State& state) {
  const std::string xml = presets::cloth("quads", static_cast<int>(state.range(0)), global_law, small_steps);
  for (auto _ : state) {
    presets::Loaded scene = presets::load(xml);
    benchmark::DoNotOptimize(scene.scene);
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_GB"] = static_cast<double>(usage.ru_maxrss) / 1048576;
}
BENCHMARK(build_and_bind)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond)->Iterations(1);

// Separates one edge after another across the middle of the sheet, and updates the map, embeddings, program and
// surface.
void one_separation(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  presets::Loaded scene = presets::load(presets::cloth("quads", cells, global_law, small_steps));
  Body& body = scene.body();
  Surface surface(*body.map, body.border);
  std::vector<Dart> edges; // between rows of faces, from the border inwards
  for (int row = cells / 8; row + 1 < cells; row += 3)
    for (int column = 0; column + 3 < cells; ++column)
      edges.push_back(
          Dart{static_cast<std::uint32_t>(8 * (row * cells + column) + 4)}); // the upper side of the quad
  std::size_t at = 0;
  for (auto _ : state) {
    if (at == edges.size()) {
      state.SkipWithError("no edge is left");
      break;
    }
    body.map->edit([&](Edit& edit) { unsew(edit, 2, edges[at]); });
    ++at;
    body.rebind();
    surface.update();
  }
  state.counters["fragments"] = static_cast<double>(count_cells(body.map->map(), Component));
}
BENCHMARK(one_separation)->Arg(100)->Iterations(2500);
BENCHMARK(one_separation)->Arg(1000)->Iterations(2500);

} // namespace
} // namespace rend
namespace rend {
namespace {
// The forces only, without the rest of the step.
void forces(benchmark::State& state) {
  presets::Loaded scene =
      presets::load(presets::cloth("quads", static_cast<int>(state.range(0)), "", small_steps));
  Body& body = scene.body();
  scene->step();
  for (auto _ : state) body.evaluate();
}
BENCHMARK(forces)->Arg(10)->Arg(64)->Arg(1000);

// Table 6.3: springs over two edges against hinges. The cost of a hinge is the difference to a run without
// bending, divided by their number.
void bending(benchmark::State& state, const std::string& bend) {
  presets::Loaded scene = presets::load(presets::cloth("quads", 16, "", small_steps, bend));
  Body& body = scene.body();
  scene->step();
  for (auto _ : state) body.evaluate();
}
BENCHMARK_CAPTURE(bending, none, "");
BENCHMARK_CAPTURE(bending, provot, R"(<bend kind="provot" k="10"/>)");
BENCHMARK_CAPTURE(bending, angular, R"(<bend kind="angular" k="0.01"/>)");
BENCHMARK_CAPTURE(bending, angular_damped, R"(<bend kind="angular" k="0.01" damping="1e-5"/>)");
} // namespace
} // namespace rend
