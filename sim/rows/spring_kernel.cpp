#include "sim/mechanics/spring_law.h"
#include "sim/rows/lanes.h"
#include "sim/rows/spring_sums.h"

namespace rend {
namespace {

using lanes::load_four;

// Below it the inverse of a squared length overflows: no direction, no force.
constexpr double least_square = 1e-300; // [m²]

// The factor s of d = xj − xi in f_i = s d, for four rows; if `summed` also k|l − l0| + λ|u·w|, a bound of the
// sum of the magnitudes of the springs in a row. 1/l is computed as l/l², so that the root and the division are
// independent.
template <bool damped, bool summed = false>
REND_INLINE Double4 spring_factor(const Double4* d, const KernelArguments& a, const std::uint32_t* i,
                                  const std::uint32_t* j, const double* values, Double4* sum = nullptr) {
  const Double4 k = load_four(values), rest = load_four(values + (damped ? 8 : 4));
  const Double4 square = sums_of(d[0] * d[0], d[1] * d[1], d[2] * d[2], d[3] * d[3]);
  const Double4 length = square_root(square), inverse = length * (1.0 / square);
  const Long4 directed = square > least_square;
  Double4 s = k * (length - rest);
  if constexpr (summed) *sum = s < 0.0 ? -s : s;
  if constexpr (damped) {
    const Double4 damping = load_four(values + 4);
    Double4 w[4];
    for (int r = 0; r < 4; ++r) w[r] = (load(a.velocity[j[r]]) - load(a.velocity[i[r]])) * d[r];
    const Double4 speed = sums_of(w[0], w[1], w[2], w[3]) * inverse;
    s += damping * speed;
    if constexpr (summed) *sum += directed ? damping * (speed < 0.0 ? -speed : speed) : Double4{};
  }
  s *= inverse;
  return directed ? s : Double4{};
}

template <bool damped, bool whole, bool summed>
REND_INLINE void run_rows(const KernelArguments& a, std::size_t begin, std::size_t end) {
  const Record* x = a.position;
  const std::uint32_t *i = a.rows.index(0) + begin, *j = a.rows.index(1) + begin, *last = i + (end - begin);
  const double* values = a.rows.lanes_at(begin);
  for (; i != last; i += 4, j += 4, values += damped ? 12 : 8) {
    prefetch<1024>(i);
    prefetch<1024>(j);
    prefetch<2048>(values);
    Double4 d[4];
    for (int r = 0; r < 4; ++r) d[r] = load(x[j[r]]) - load(x[i[r]]);
    Double4 sum;
    const Double4 s = spring_factor<damped, summed>(d, a, i, j, values, &sum);
    if constexpr (summed) {
      for (int r = 0; r < 4; ++r) {
        const Double4 f = splat(s[r]) * d[r], size = __builtin_shuffle(Double4{}, sum, Long4{0, 1, 2, 4 + r});
        if (whole || (i[r] >= a.low && i[r] < a.high)) store(a.force[i[r]], load(a.force[i[r]]) + f + size);
        if (whole || (j[r] >= a.low && j[r] < a.high)) store(a.force[j[r]], load(a.force[j[r]]) - f + size);
      }
      continue;
    }
    for (int r = 0; r < 4; ++r) {
      const Double4 f = splat(s[r]) * d[r];
      if (whole || (i[r] >= a.low && i[r] < a.high)) store(a.force[i[r]], load(a.force[i[r]]) + f);
      if (whole || (j[r] >= a.low && j[r] < a.high)) store(a.force[j[r]], load(a.force[j[r]]) - f);
    }
  }
}

REND_INLINE bool is_whole(const KernelArguments& a, std::size_t block) {
  const PackedRows::Range range = a.rows.range(block);
  return range.low >= a.low && range.high < a.high;
}

// Adjacent blocks are run as one: the processor mispredicts the branch at the end of each block.
template <bool damped, bool summed> REND_INLINE void run(const KernelArguments& a) {
  for (std::size_t block = a.first; block < a.last;) {
    const PackedRows::Range range = a.rows.range(block);
    const bool all = is_whole(a, block), none = range.low >= a.high || range.high < a.low;
    const std::size_t begin = a.rows.begin(block);
    std::size_t end = begin + a.rows.padded_in(block++);
    if (none) continue;
    if (!all) {
      run_rows<damped, false, summed>(a, begin, end);
      continue;
    }
    while (block < a.last && a.rows.begin(block) == end && is_whole(a, block)) end += a.rows.padded_in(block++);
    run_rows<damped, true, summed>(a, begin, end);
  }
}

template <bool damped> REND_INLINE void run_corners(const KernelArguments& a) {
  for (std::size_t block = a.first; block < a.last; ++block) {
    const std::size_t begin = a.rows.begin(block), end = begin + a.rows.padded_in(block);
    for (std::size_t at = begin; at < end; at += PackedRows::lanes) {
      const std::uint32_t *i = a.rows.index(0) + at, *j = a.rows.index(1) + at;
      const std::uint32_t *ci = a.rows.index(2) + at, *cj = a.rows.index(3) + at;
      Double4 d[4];
      for (int r = 0; r < 4; ++r) d[r] = load(a.position[j[r]]) - load(a.position[i[r]]);
      const Double4 s = spring_factor<damped>(d, a, i, j, a.rows.lanes_at(at));
      for (int r = 0; r < 4; ++r) {
        const Double4 f = splat(s[r]) * d[r];
        store(a.force[ci[r]], load(a.force[ci[r]]) + f);
        store(a.force[cj[r]], load(a.force[cj[r]]) - f);
      }
    }
  }
}

} // namespace

void spring_forces_with_sums(const KernelArguments& a) {
  a.damped ? at_width<run<true, true>>(a) : at_width<run<false, true>>(a);
}

Kernel spring_kernel() {
  return {[](const ForceLaw& law) { return &law == spring_law().get(); },
          [](const KernelArguments& a) {
            a.damped ? at_width<run<true, false>>(a) : at_width<run<false, false>>(a);
          },
          [](const KernelArguments& a) {
            a.damped ? at_width<run_corners<true>>(a) : at_width<run_corners<false>>(a);
          }};
}

} // namespace rend
