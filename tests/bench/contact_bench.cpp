// The search of contact and what touches, without the answer: 10,000 cubes that are packed, that draw apart,
// and that have flown apart. All of them turn in each step.
#include "sim/contact/fragment_contact.h"
#include "sim/cubes.h"

#include <benchmark/benchmark.h>

#include <ctime>

namespace rend {
namespace {

// [s], of this thread: other programs of the machine do not count.
double now() {
  timespec at{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &at);
  return static_cast<double>(at.tv_sec) + 1e-9 * static_cast<double>(at.tv_nsec);
}

// state: their spacing, in hundredths of an edge; the growth of it in a step, in thousandths. Counters, of all
// steps: searches of two cubes, sweeps of all cubes; of the last step: candidates.
void contact_of_cubes(benchmark::State& state) {
  cubes::Cubes all({25, 20, 20}, 0.01 * static_cast<double>(state.range(0)));
  FragmentContact contact;
  ContactAnswer answer(false);
  const double growth = 0.001 * static_cast<double>(state.range(1));
  double size = 1;
  const auto step = [&] {
    size += growth;
    all.step([&](const Vec3& x) { return Vec3(size * x); }, 0.02);
    answer.begin();
    const double start = now();
    contact.detect(all.bodies, answer);
    return now() - start;
  };
  step(); // the first search
  for (auto _ : state) state.SetIterationTime(step());
  state.counters["searches"] = static_cast<double>(contact.searches());
  state.counters["sweeps"] = static_cast<double>(contact.sweeps());
  state.counters["candidates"] = static_cast<double>(contact.pairs());
}
BENCHMARK(contact_of_cubes)
    ->ArgNames({"spacing", "growth"})
    ->Args({105, 0})
    ->Args({105, 2})
    ->Args({400, 10})
    ->Iterations(20)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace rend
