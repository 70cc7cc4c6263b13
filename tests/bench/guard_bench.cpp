// What the guard costs in steps that it accepts: the same scenes with and without it, interleaved.
#include "sim/presets.h"

#include <benchmark/benchmark.h>

#include <ctime>

namespace rend {
namespace {

const char* const bar =
    R"(<scene><body><bar pattern="tetrahedra" cells="40 5 5" size="4 0.5 0.5"/><mass total="10"/>)"
    R"(<elasticity model="corotational" young="1e5" poisson="0.3"/><fix side="-x"/></body>)"
    R"(<time step="1e-5" duration="1"/></scene>)";

std::string cloth(const std::string& scheme, int cells) {
  return presets::cloth("quads", cells, "",
                        R"(<time step="1e-6" duration="1" integrator=")" + scheme + R"("/>)");
}

// In one process and interleaved, since run times drift from minute to minute by more than the difference.
void guarded(benchmark::State& state, const std::string& xml) {
  const presets::Loaded with = presets::load(xml), without = presets::load(xml, {.guard = false});
  constexpr int steps = 640;
  double seconds[2] = {};
  for (auto _ : state) {
    for (int which = 0; which < 2; ++which) {
      const presets::Loaded& scene = which == 0 ? with : without;
      const std::clock_t start = std::clock();
      for (int n = 0; n < steps; ++n) scene->step();
      seconds[which] += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    }
  }
  state.counters["percent"] = 100 * (seconds[0] / seconds[1] - 1);
  state.counters["looks"] = static_cast<double>(with->guard().energy_tests);
}
BENCHMARK_CAPTURE(guarded, cloth_10_symplectic, cloth("symplectic", 10));
BENCHMARK_CAPTURE(guarded, cloth_10_rk4, cloth("rk4", 10));
BENCHMARK_CAPTURE(guarded, cloth_100_symplectic, cloth("symplectic", 100));
BENCHMARK_CAPTURE(guarded, cloth_100_rk4, cloth("rk4", 100));
BENCHMARK_CAPTURE(guarded, tetrahedra_6000, bar);

} // namespace
} // namespace rend
