#include "sim/mechanics/mass_tensor.h"
#include "sim/rows/lanes.h"

namespace rend {
namespace {

using namespace lanes;

// u + βv of one particle of four rows.
template <bool damped>
REND_INLINE Vector moved(const KernelArguments& a, const std::uint32_t* index, double damping) {
  Double4 u[4];
  for (int r = 0; r < 4; ++r) {
    u[r] = load(a.position[index[r]]) - load(a.rest[index[r]]);
    if constexpr (damped) u[r] += splat(damping) * load(a.velocity[index[r]]);
  }
  return transposed(u[0], u[1], u[2], u[3]);
}

REND_INLINE Vector minus_product(const Double4* K, const Vector& u) {
  return {-(K[0] * u.x + K[1] * u.y + K[2] * u.z), -(K[3] * u.x + K[4] * u.y + K[5] * u.z),
          -(K[6] * u.x + K[7] * u.y + K[8] * u.z)};
}
REND_INLINE Vector minus_transposed_product(const Double4* K, const Vector& u) {
  return {-(K[0] * u.x + K[3] * u.y + K[6] * u.z), -(K[1] * u.x + K[4] * u.y + K[7] * u.z),
          -(K[2] * u.x + K[5] * u.y + K[8] * u.z)};
}

template <int particles, bool damped, bool corners, bool whole>
REND_INLINE void run_rows(const KernelArguments& a, double damping, std::size_t block) {
  constexpr int place = corners ? particles : 0; // index column
  const std::size_t begin = a.rows.begin(block), end = begin + a.rows.padded_in(block);
  for (std::size_t at = begin; at < end; at += PackedRows::lanes) {
    Double4 K[9];
    for (int n = 0; n < 9; ++n) K[n] = load_four(a.rows.lanes_at(at) + 4 * n);
    const Vector u = moved<damped>(a, a.rows.index(0) + at, damping);
    if constexpr (particles == 1) {
      scatter<whole>(a, a.rows.index(place) + at, minus_product(K, u));
    } else {
      const Vector other = moved<damped>(a, a.rows.index(1) + at, damping);
      scatter<whole>(a, a.rows.index(place) + at, minus_product(K, other));
      scatter<whole>(a, a.rows.index(place + 1) + at, minus_transposed_product(K, u));
    }
  }
}

template <int particles, bool damped, bool corners> REND_INLINE void run_blocks(const KernelArguments& a) {
  const double damping = static_cast<const MassTensorLaw&>(a.law).damping();
  for (std::size_t block = a.first; block < a.last; ++block) {
    const PackedRows::Range range = a.rows.range(block);
    if (corners || (range.low >= a.low && range.high < a.high))
      run_rows<particles, damped, corners, true>(a, damping, block);
    else if (range.low < a.high && range.high >= a.low)
      run_rows<particles, damped, corners, false>(a, damping, block);
  }
}

template <int particles, bool corners> REND_INLINE void run(const KernelArguments& a) {
  if (a.damped)
    run_blocks<particles, true, corners>(a);
  else
    run_blocks<particles, false, corners>(a);
}

} // namespace

Kernel tensor_kernel() {
  return {[](const ForceLaw& law) { return dynamic_cast<const MassTensorLaw*>(&law) != nullptr; },
          [](const KernelArguments& a) {
            a.law.particles() == 1 ? at_width<run<1, false>>(a) : at_width<run<2, false>>(a);
          },
          [](const KernelArguments& a) {
            a.law.particles() == 1 ? at_width<run<1, true>>(a) : at_width<run<2, true>>(a);
          }};
}

} // namespace rend
