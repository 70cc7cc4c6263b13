// Chooses at run time which vector unit of the processor the inner loops use. Results do not depend on it.
//
// A loop is an always_inline function; at_width<loop>(arguments) runs the copy of it that was compiled for the
// chosen unit: the widest that the processor has, or the one named by REND_SIMD in the environment:
//
//   sse2     two doubles at a time, what every x86-64 has (other processors: their baseline)
//   avx2     four
//
// There is no AVX-512: it gained a sixth on hexahedra and nothing on tetrahedra and springs, eight lanes lost a
// quarter on springs, and g++ 12.2 compiled hinges wrongly for it (the test HingeKernel.adds_what_the_law_says
// shows it).
//
// Vectors have four lanes for every unit (simd.h), every operation is IEEE's on each of them, and none is
// contracted to a fused multiply-add (CMakeLists.txt): all copies give identical bits, so the choice only
// serves tests and measurements. GCC's target_clones would choose as well, but the choice cannot be overridden.
#pragma once

#include <string>

namespace rend {

enum class SimdWidth { Sse2, Avx2 };

SimdWidth simd_width(); // read once. UserError 64: REND_SIMD names no unit, or one that the processor lacks
std::string name_of(SimdWidth width);
bool has_width(SimdWidth width); // of this processor

#define REND_INLINE __attribute__((always_inline)) inline

#ifdef __x86_64__

template <auto loop, class... A> [[gnu::noinline]] auto in_sse2(A&... a) {
  return loop(a...);
}
template <auto loop, class... A> [[gnu::noinline, gnu::target("avx2")]] auto in_avx2(A&... a) {
  return loop(a...);
}

template <auto loop, class... A> auto at_width(A&&... a) {
  if (simd_width() == SimdWidth::Avx2) return in_avx2<loop>(a...);
  return in_sse2<loop>(a...);
}

#else

template <auto loop, class... A> auto at_width(A&&... a) {
  return loop(a...);
}

#endif

} // namespace rend
