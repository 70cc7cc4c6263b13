// Implicit steps and static solves, with iterative and direct linear solvers.
#include "sim/presets.h"
#include "sim/solve/linear_solver.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

namespace rend {
namespace {

std::string time_of(const char* scheme) {
  return fmt::format(R"(<time step="0.01" integrator="{}" duration="100"/>)", scheme);
}

// 20,000 tetrahedra in 0.2 m, E = 1e6 Pa, 1000 kg/m³, held at one end, falling there.
std::string solid(const char* scheme) {
  return R"(<scene><body><bar pattern="tetrahedra" cells="16 16 16" size="0.2 0.2 0.2"/>)"
         R"(<mass density="1000"/><elasticity young="1e6" poisson="0.35"/><fix side="-x"/></body>)" +
         time_of(scheme) + "</scene>";
}

void steps(benchmark::State& state, const std::string& xml) {
  presets::Loaded scene = presets::load(xml);
  scene->step(); // computes the elimination order and allocates
  const SolverFigures before = scene.body().integrator->solver();
  for (auto _ : state) scene->step();
  const SolverFigures after = scene.body().integrator->solver();
  const auto each = [&](long a, long b) {
    return static_cast<double>(b - a) / static_cast<double>(state.iterations());
  };
  state.counters["newton"] = each(before.newton, after.newton);
  state.counters["cg"] = each(before.cg, after.cg);
  state.counters["factors"] = each(before.factorisations, after.factorisations);
  state.counters["vertices"] = static_cast<double>(scene.body().vertices());
}

void implicit_cloth(benchmark::State& state) {
  steps(state, presets::cloth("quads", static_cast<int>(state.range(0)), "", time_of("implicit")));
}
BENCHMARK(implicit_cloth)->Arg(10)->Arg(64)->Unit(benchmark::kMillisecond);

void implicit_solid(benchmark::State& state) {
  steps(state, solid("implicit"));
}
BENCHMARK(implicit_solid)->Unit(benchmark::kMillisecond)->Iterations(10);

// The organ of 20,000 tetrahedra, held at its base, falling; to be run in the folder that contains presets/.
// Argument: ν in hundredths.
void implicit_organ(benchmark::State& state) {
  steps(state, fmt::format(R"(<scene><body><mesh file="presets/meshes/organ-20k.msh"/><mass density="1000"/>)"
                           R"(<elasticity young="1e6" poisson="0.{}"/><fix group="base"/></body>{}</scene>)",
                           state.range(0), time_of("implicit")));
}
BENCHMARK(implicit_organ)->Arg(30)->Arg(45)->Unit(benchmark::kMillisecond)->Iterations(10);

// The matrix of an implicit step of a cloth, solved to four digits.
struct System4 {
  presets::Loaded scene;
  BlockMatrix matrix;
  Records right, solution;

  explicit System4(int cells) : scene(presets::load(presets::cloth("quads", cells, "", time_of("implicit")))) {
    scene->step();
    Body& body = scene.body();
    matrix.reset(body.pattern());
    body.add_stiffness(body.map->position().values().data(), body.map->velocity().values().data(),
                       Tangent::SemiDefinite, 1e-4, 1e-2, matrix);
    for (std::size_t i = 0; i < body.vertices(); ++i) matrix.add_diagonal(i, 1 / body.inverse_mass[i]);
    right.assign(body.vertices(), Record(0, 0, -9.81));
  }
};

void solve_by_iterations(benchmark::State& state) {
  System4 s(static_cast<int>(state.range(0)));
  Preconditioner preconditioner;
  ConjugateGradient gradient;
  for (auto _ : state) {
    preconditioner.set_matrix(s.matrix, Precision::Double);
    state.counters["cg"] = gradient.solve(preconditioner, 1, s.right, s.solution, 1e-4, 10000).iterations;
  }
}
BENCHMARK(solve_by_iterations)->Arg(10)->Arg(30)->Arg(64)->Unit(benchmark::kMicrosecond);

void solve_directly(benchmark::State& state) {
  System4 s(static_cast<int>(state.range(0)));
  s.solution.resize(s.right.size());
  BlockFactor factor;
  factor.analyse(s.matrix.pattern());
  for (auto _ : state) {
    factor.factorise(s.matrix);
    factor.solve(s.right.data(), s.solution.data());
  }
  state.counters["products"] = factor.products() / static_cast<double>(s.matrix.pattern()->blocks());
}
BENCHMARK(solve_directly)->Arg(10)->Arg(30)->Arg(64)->Unit(benchmark::kMicrosecond);

} // namespace
} // namespace rend
