#include "sim/base/simd.h"
#include "sim/mechanics/spring_law.h"
#include "sim/program/spring_sums.h"

namespace rend {
namespace {

// The factor s of d = xj − xi in f_i = s d, of four rows; and k|l − l0| + λ|u·w|, where asked for: the sum of what the
// springs that a row stands for can do at most.
template <bool damped, bool summed = false>
REND_INLINE Double4 spring_factor(const Double4* d, const KernelArguments& a, const std::uint32_t* i,
                                  const std::uint32_t* j, std::size_t at, Double4* sum = nullptr) {
  Double4 k, rest;
  const double* values = a.rows.lanes_at(at); // k, damping, rest
  __builtin_memcpy(&k, values, sizeof k);
  __builtin_memcpy(&rest, values + 8, sizeof rest);
  const Double4 square = sums_of(d[0] * d[0], d[1] * d[1], d[2] * d[2], d[3] * d[3]);
  const Double4 length = square_root(square);
  const Double4 inverse = 1.0 / length;
  Double4 s = k * (length - rest);
  if constexpr (summed) *sum = s < 0.0 ? -s : s;
  if constexpr (damped) {
    Double4 damping, w[4];
    __builtin_memcpy(&damping, values + 4, sizeof damping);
    for (int r = 0; r < 4; ++r) w[r] = (load(a.velocity[j[r]]) - load(a.velocity[i[r]])) * d[r];
    const Double4 speed = sums_of(w[0], w[1], w[2], w[3]) * inverse;
    s += damping * speed;
    if constexpr (summed) *sum += square > 0.0 ? damping * (speed < 0.0 ? -speed : speed) : Double4{};
  }
  s *= inverse;
  return square > 0.0 ? s : Double4{}; // no direction, no force
}

template <bool damped, bool whole, bool summed>
REND_INLINE void run_block(const KernelArguments& a, std::size_t block) {
  const std::size_t begin = block * PackedRows::block_size, end = begin + a.rows.padded_in(block);
  const Record* x = a.position;
  for (std::size_t at = begin; at < end; at += PackedRows::lanes) {
    const std::uint32_t *i = a.rows.index(0) + at, *j = a.rows.index(1) + at;
    Double4 d[4];
    for (int r = 0; r < 4; ++r) d[r] = load(x[j[r]]) - load(x[i[r]]);
    Double4 sum;
    const Double4 s = spring_factor<damped, summed>(d, a, i, j, at, &sum);
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

// Asks for the rows of the block after next: the gaps between blocks stop the processor from guessing them.
REND_INLINE void fetch_ahead(const PackedRows& rows, std::size_t block) {
  constexpr std::size_t ahead = 2, line = 64;
  if (block + ahead >= rows.blocks()) return;
  const std::size_t begin = (block + ahead) * PackedRows::block_size, count = rows.rows_in(block + ahead);
  const double* values = rows.lanes_at(begin);
  for (std::size_t n = 0; n < 3 * count; n += line / sizeof(double)) __builtin_prefetch(values + n);
  for (std::size_t n = 0; n < count; n += line / sizeof(std::uint32_t)) {
    __builtin_prefetch(rows.index(0) + begin + n);
    __builtin_prefetch(rows.index(1) + begin + n);
  }
}

template <bool damped, bool summed> REND_INLINE void run(const KernelArguments& a) {
  for (std::size_t block = a.first; block < a.last; ++block) {
    fetch_ahead(a.rows, block);
    const PackedRows::Range range = a.rows.range(block);
    if (range.low >= a.high || range.high < a.low) continue;
    if (range.low >= a.low && range.high < a.high)
      run_block<damped, true, summed>(a, block);
    else
      run_block<damped, false, summed>(a, block);
  }
}

template <bool damped> REND_INLINE void run_corners(const KernelArguments& a) {
  for (std::size_t block = a.first; block < a.last; ++block) {
    const std::size_t begin = block * PackedRows::block_size, end = begin + a.rows.padded_in(block);
    for (std::size_t at = begin; at < end; at += PackedRows::lanes) {
      const std::uint32_t *i = a.rows.index(0) + at, *j = a.rows.index(1) + at;
      const std::uint32_t *ci = a.rows.index(2) + at, *cj = a.rows.index(3) + at;
      Double4 d[4];
      for (int r = 0; r < 4; ++r) d[r] = load(a.position[j[r]]) - load(a.position[i[r]]);
      const Double4 s = spring_factor<damped>(d, a, i, j, at);
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
  return {[](const Law& law) { return &law == spring_law().get(); },
          [](const KernelArguments& a) {
            a.damped ? at_width<run<true, false>>(a) : at_width<run<false, false>>(a);
          },
          [](const KernelArguments& a) {
            a.damped ? at_width<run_corners<true>>(a) : at_width<run_corners<false>>(a);
          }};
}

} // namespace rend
