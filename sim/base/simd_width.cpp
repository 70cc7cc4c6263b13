#include "sim/base/simd_width.h"

#include "sim/base/enum_words.h"
#include "sim/base/error.h"
#include "sim/base/wording.h"

#include <array>
#include <cstdlib>
#include <vector>

namespace rend {
namespace {

constexpr std::array all_widths{SimdWidth::Sse2, SimdWidth::Avx2}; // narrowest first

SimdWidth widest() {
  SimdWidth width = SimdWidth::Sse2;
  for (SimdWidth one : all_widths)
    if (has_width(one)) width = one;
  return width;
}

SimdWidth chosen() {
  const char* word = std::getenv("REND_SIMD");
  if (!word || !*word) return widest();
  std::vector<std::string> here;
  for (SimdWidth one : all_widths)
    if (has_width(one)) here.push_back(name_of(one));
  for (SimdWidth one : all_widths) {
    if (name_of(one) != word) continue;
    if (has_width(one)) return one;
    throw UserError(Exit::Usage, {"REND_SIMD"}, "this processor has no " + name_of(one),
                    "there are: " + listed(here));
  }
  throw UserError(Exit::Usage, {"REND_SIMD"}, "there is no vector unit " + in_quotes(word),
                  suggestion(word, here, "there are"));
}

} // namespace

SimdWidth simd_width() {
  static const SimdWidth width = chosen();
  return width;
}

std::string name_of(SimdWidth width) {
  static constexpr EnumWords<SimdWidth::Avx2> words{"sse2", "avx2"};
  return words[width];
}

bool has_width(SimdWidth width) {
#ifdef __x86_64__
  __builtin_cpu_init();
  if (width == SimdWidth::Avx2) return __builtin_cpu_supports("avx2") != 0;
#endif
  return width == SimdWidth::Sse2;
}

} // namespace rend
