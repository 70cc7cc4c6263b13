#include "render/facts/machine_speed.h"

#include "render/clip/session.h"
#include "sim/base/simd.h"
#include "sim/base/threads.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace rend {
namespace {

constexpr std::size_t records = std::size_t{1} << 21U; // per array: 64 MiB
constexpr int tries = 7;
constexpr long turns = 1L << 18U; // iterations of the arithmetic loop
constexpr std::size_t chains = 12;

struct Arrays {
  std::vector<Record> a, b, c;
};

// The shortest of several runs [s].
template <class F> double seconds_of(F&& f) {
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n < tries; ++n) {
    const double start = wall_clock();
    f();
    least = std::min(least, wall_clock() - start);
  }
  return least;
}

REND_INLINE void triad(Arrays& arrays, std::size_t begin, std::size_t end) {
  const Double4 s = splat(3);
  for (std::size_t i = begin; i < end; ++i) stream(arrays.a[i], load(arrays.b[i]) + s * load(arrays.c[i]));
}

// Converges to 1 from any value. The result is stored, or the compiler would remove the computation.
REND_INLINE void multiply_add(Record& out) {
  std::array<Double4, chains> x;
  for (std::size_t n = 0; n < chains; ++n) x[n] = splat(static_cast<double>(n));
  const Double4 m = splat(0.5), a = splat(0.5);
  for (long turn = 0; turn < turns; ++turn)
    for (std::size_t n = 0; n < chains; ++n) x[n] = x[n] * m + a;
  Double4 sum{};
  for (const Double4& each : x) sum += each;
  store(out, sum);
}

double bytes_a_second(int threads) {
  Arrays arrays;
  for (auto* array : {&arrays.a, &arrays.b, &arrays.c}) array->assign(records, Record{});
  const double seconds = seconds_of([&] {
    parallel_ranges(threads, records, [&](std::size_t begin, std::size_t end) {
      at_width<triad>(arrays, begin, end);
      fence_streams();
    });
  });
  return 3.0 * records * sizeof(Record) / seconds;
}

double operations_a_second(int threads) {
  std::vector<Record> out(static_cast<std::size_t>(threads) * 2); // per thread, on a cache line of its own
  const double seconds = seconds_of([&] {
    parallel_ranges(threads, static_cast<std::size_t>(threads), [&](std::size_t begin, std::size_t end) {
      for (std::size_t thread = begin; thread < end; ++thread) at_width<multiply_add>(out[2 * thread]);
    });
  });
  return 2.0 * 4 * chains * turns * threads / seconds; // each operation has four lanes
}

} // namespace

MachineSpeed measure_machine(int threads) {
  return {threads, bytes_a_second(threads), operations_a_second(threads)};
}

} // namespace rend
