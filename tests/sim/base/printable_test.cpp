#include "sim/base/printable.h"

#include <gtest/gtest.h>

namespace rend::printable_test {
namespace {

TEST(Printable, ShowsAsEscapesWhatWouldAct) {
  // letters of any script are kept
  EXPECT_EQ(printable("ν = ½ → 𝄞, العربية, \\x1b"), "ν = ½ → 𝄞, العربية, \\x1b");
  EXPECT_EQ(printable(std::string("\0\x01\t\n\r\033\x7f", 7)), R"(\x00\x01\t\n\x0d\x1b\x7f)");
  EXPECT_EQ(printable("\u0080\u0085\u009b31m\u009f\u00a0"), "\\u{80}\\u{85}\\u{9b}31m\\u{9f}\u00a0");
  EXPECT_EQ(printable("\u2027\u2028\u202a\u202e\u202f"), "\u2027\\u{2028}\\u{202a}\\u{202e}\u202f");
  EXPECT_EQ(printable("\u2065\u2066\u2069\u206a"), "\u2065\\u{2066}\\u{2069}\u206a");
  EXPECT_EQ(printable("\ufffd\ufffe\U0010ffff"), "\ufffd\\u{fffe}\\u{10ffff}"); // XML allows only the first
  EXPECT_EQ(printable("\xff\xfe \xe2\x82"), R"(\xff\xfe \xe2\x82)");            // invalid UTF-8; truncated
  // Overlong, a surrogate, out of range.
  EXPECT_EQ(printable("\xc0\xaf|\xed\xa0\x80|\xf4\x90\x80\x80"), R"(\xc0\xaf|\xed\xa0\x80|\xf4\x90\x80\x80)");
  EXPECT_EQ(printable_lines("a\tb\n\033c\r\n"), "a\tb\n\\x1bc\\x0d\n");
}

// Idempotent: messages are composed of printable names and made printable again as a whole.
TEST(Printable, TwiceShowsTheSame) {
  std::string all;
  for (int c = 0; c < 256; ++c) all += static_cast<char>(c);
  all += "\u202e\u0085\u2028";
  EXPECT_EQ(printable(printable(all)), printable(all));
  EXPECT_EQ(printable_lines(printable(all)), printable(all));
}

} // namespace
} // namespace rend::printable_test
