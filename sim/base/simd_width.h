// Which of a processor's vector units the inner loops use: chosen when the program runs, and nothing else
// changes.
//
// A loop is an always_inline function; at_width<loop>(arguments) runs the copy of it that was compiled for the
// chosen unit. That is the widest one that the processor has, or what REND_SIMD in the environment asks for:
//
//   sse2     two doubles at a time, what every x86-64 has (on other processors: what they all have)
//   avx2     four
//
// AVX-512 is not there: it gained a sixth on hexahedra and nothing on tetrahedra and springs, eight lanes lost
// a quarter on springs, and hinges came out wrong for it from g++ 12.2 (HingeKernel.adds_what_the_law_says
// tells).
//
// Vectors have four lanes whatever the unit (simd.h), every operation is IEEE's on each of them, and none is
// contracted (CMakeLists.txt): all copies give the same bits, which is why the choice is for tests and
// measurements alone. GCC's target_clones would choose as well, but cannot be told what.
#pragma once

#include <string>

namespace rend {

enum class SimdWidth { Sse2, Avx2 };

SimdWidth simd_width(); // read once. UserError 64: REND_SIMD is no such word, or the processor does not have it
std::string name_of(SimdWidth width);
bool has_width(SimdWidth width); // this processor

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
