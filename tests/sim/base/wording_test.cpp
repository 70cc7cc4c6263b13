#include "sim/base/wording.h"

#include <gtest/gtest.h>
#include <vector>

namespace rend {
namespace {

const std::vector<std::string> words = {"stretch", "shear", "bend", "thickness", "k", "eye"};

TEST(Wording, FindsTheNearestName) {
  EXPECT_EQ(nearest("strech", words), "stretch");  // a letter too few
  EXPECT_EQ(nearest("sheear", words), "shear");    // one too many
  EXPECT_EQ(nearest("bned", words), "bend");       // two swapped
  EXPECT_EQ(nearest("BEND", words), "bend");       // capitals
  EXPECT_EQ(nearest("thick", words), "thickness"); // a beginning
  EXPECT_EQ(nearest("ey", words), "eye");
}

TEST(Wording, KnowsANameByItsLastPart) {
  const std::vector<std::string> names = {"strain", "vertex-stress", "mp4", "ab"};
  EXPECT_EQ(nearest("stress", names), "vertex-stress");
  EXPECT_EQ(nearest("clip.mp4", names), "mp4");
  EXPECT_EQ(nearest(".mp4", names), "mp4");
  EXPECT_EQ(nearest("x.ab", names), "");
  EXPECT_EQ(nearest("distress", names), "");
}

TEST(Wording, FindsNothingWhereNothingIsNear) {
  EXPECT_EQ(nearest("viscosity", words), "");
  EXPECT_EQ(nearest("g", words), ""); // every name of one letter is one letter away
  EXPECT_EQ(nearest("", words), "");
  EXPECT_EQ(nearest("bend", {}), "");
}

TEST(Wording, IsNotSlowedByAHugeName) {
  EXPECT_EQ(nearest(std::string(10'000'000, 'x'), words), "");
}

TEST(Wording, SuggestsTheNearestAndListsAll) {
  EXPECT_EQ(suggestion("bnd", words), "did you mean 'bend'?");
  EXPECT_EQ(suggestion("qqq", words), "");
  const std::vector<std::string> two = {"one", "two"};
  EXPECT_EQ(suggestion("tow", two, "there are"), "did you mean 'two'? there are: one, two");
  EXPECT_EQ(suggestion("qqq", two, "there are"), "there are: one, two");
  EXPECT_EQ(suggestion("qqq", {}, "there are"), "");
}

TEST(Wording, QuotesKeepATerminalSafe) {
  EXPECT_EQ(in_quotes("abc"), "'abc'");
  EXPECT_EQ(in_quotes("a\033[1m\nb\x7f"), "'a [1m b '");
  EXPECT_EQ(in_quotes(std::string(100, 'x')), "'" + std::string(60, 'x') + "...'");
  EXPECT_EQ(in_quotes("é€😀"), "'é€😀'");
  EXPECT_EQ(in_quotes("\xff\xfe"), "'  '"); // no UTF-8
  EXPECT_EQ(in_quotes("\xc0\xaf|\xed\xa0\x80|\xf4\x90\x80\x80"),
            "'  |   |    '"); // overlong, surrogate, too high
  EXPECT_EQ(in_quotes("\xc2\x9b"
                      "31m"),
            "'  31m'");                     // a terminal's control sequence in one character
  EXPECT_EQ(in_quotes("\xe2\x82"), "'  '"); // cut off
  // The 60th byte lies within the é, which is left out whole.
  EXPECT_EQ(in_quotes(std::string(59, 'x') + "é and more"), "'" + std::string(59, 'x') + "...'");
}

} // namespace
} // namespace rend
