// Four doubles at once, with identical bits on every processor.
//
// GCC lowers its vector types to the registers of the target (two SSE registers, one AVX register). Every
// operation is the IEEE operation on each lane, so the width never shows in a result. simd_width.h chooses the
// target at run time.
#pragma once

#include "sim/base/record.h"
#include "sim/base/simd_width.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace rend {

using Double4 = double __attribute__((vector_size(32)));
using Long4 = long long __attribute__((vector_size(32)));

REND_INLINE Double4 load(const Record& r) {
  return *reinterpret_cast<const Double4*>(&r);
}
REND_INLINE void store(Record& r, Double4 v) {
  *reinterpret_cast<Double4*>(&r) = v;
}
// A non-temporal store, for large arrays that are not read again soon: bypassing the caches saves reading the
// lines that are overwritten.
REND_INLINE void stream(Record& r, Double4 v) {
#ifdef __SSE2__
  _mm_stream_pd(&r.x, __m128d{v[0], v[1]});
  _mm_stream_pd(&r.z, __m128d{v[2], v[3]});
#else
  store(r, v);
#endif
}

// Prefetches what a sequential loop reads `bytes_on` bytes further, maybe beyond the end of the array: hardware
// prefetchers stop at page boundaries and do not look far enough ahead for many arrays at once.
template <std::size_t bytes_on> REND_INLINE void prefetch(const void* here) {
  __builtin_prefetch(static_cast<const char*>(here) + bytes_on);
}

REND_INLINE Double4 splat(double s) {
  return Double4{s, s, s, s};
}

REND_INLINE Double4 square_root(Double4 v) {
  return Double4{__builtin_sqrt(v[0]), __builtin_sqrt(v[1]), __builtin_sqrt(v[2]), __builtin_sqrt(v[3])};
}

// The sums (x + y) + z of four records, whose fourth component is 0.
REND_INLINE Double4 sums_of(Double4 a, Double4 b, Double4 c, Double4 d) {
  const Double4 ab = __builtin_shuffle(a, b, Long4{0, 4, 2, 6}) + __builtin_shuffle(a, b, Long4{1, 5, 3, 7});
  const Double4 cd = __builtin_shuffle(c, d, Long4{0, 4, 2, 6}) + __builtin_shuffle(c, d, Long4{1, 5, 3, 7});
  return __builtin_shuffle(ab, cd, Long4{0, 1, 4, 5}) + __builtin_shuffle(ab, cd, Long4{2, 3, 6, 7});
}

// A fence: all non-temporal stores become visible to other threads.
inline void fence_streams() {
#ifdef __SSE2__
  _mm_sfence();
#endif
}

} // namespace rend
