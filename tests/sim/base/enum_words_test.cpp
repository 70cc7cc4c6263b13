#include "sim/base/enum_words.h"

#include <gtest/gtest.h>

#include <type_traits>

namespace rend::enum_words_test {
namespace {

enum class Colour { Red, Green, Blue };
using Words = EnumWords<Colour::Blue>;

TEST(EnumWords, has_one_for_each_enumerator) {
  static constexpr Words words{"red", "green", "blue"};
  EXPECT_STREQ(words[Colour::Red], "red");
  EXPECT_STREQ(words[Colour::Green], "green");
  EXPECT_STREQ(words[Colour::Blue], "blue");
}

TEST(EnumWords, does_not_compile_with_a_word_too_few_or_too_many) {
  static_assert(std::is_constructible_v<Words, const char*, const char*, const char*>);
  static_assert(!std::is_constructible_v<Words, const char*, const char*>);
  static_assert(!std::is_constructible_v<Words, const char*, const char*, const char*, const char*>);
}

} // namespace
} // namespace rend::enum_words_test
