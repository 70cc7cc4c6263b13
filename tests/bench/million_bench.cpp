// A body of a million tetrahedra that breaks: whether a step with many separations takes much longer than
// others.
#include "sim/boundary/solid_surface.h"
#include "sim/presets.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <regex>
#include <sys/resource.h>

namespace rend {
namespace {

// The world and the body of presets/showcase/slab.xml, with the given number of cells, without its <look>, and
// split at vertices instead of cut.
std::string slab(const std::string& cells) {
  std::ifstream file(std::string(REND_ROOT) + "/presets/showcase/slab.xml");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::regex others(
      R"re( fragments|<(look|camera|image)[^>]*/>| (colour|change|smallest-part)="[^"]*")re");
  text = std::regex_replace(text, others, "");
  return std::regex_replace(text, std::regex(R"re(cells="[^"]*")re"), "cells=\"" + cells + "\"");
}

void million(benchmark::State& state) {
  presets::Loaded scene = presets::load(slab("152 102 11"));
  SolidSurface surface(*scene.body().map, scene.body().border);
  std::vector<double> seconds; // of each step, including the update of the surface
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    scene->step();
    surface.update();
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
  std::nth_element(seconds.begin(), middle, seconds.end());
  const double median = *middle;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["median_s"] = median;
  state.counters["longest_over_median"] = *std::max_element(seconds.begin(), seconds.end()) / median;
  state.counters["tears"] = static_cast<double>(scene->tears());
  state.counters["peak_GB"] = static_cast<double>(usage.ru_maxrss) / 1048576;
}
BENCHMARK(million)->Name("figure/million")->Unit(benchmark::kMillisecond)->Iterations(400);

} // namespace
} // namespace rend
