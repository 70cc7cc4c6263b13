#include "sim/base/wording.h"

#include <gtest/gtest.h>
#include <vector>

namespace rend::wording_test {
namespace {

const std::vector<std::string> words = {"stretch", "shear", "bend", "thickness", "k", "eye"};

TEST(Wording, FindsTheNearestName) {
  EXPECT_EQ(nearest("strech", words), "stretch");  // a missing letter
  EXPECT_EQ(nearest("sheear", words), "shear");    // an extra letter
  EXPECT_EQ(nearest("bned", words), "bend");       // two letters swapped
  EXPECT_EQ(nearest("BEND", words), "bend");       // capitals
  EXPECT_EQ(nearest("thick", words), "thickness"); // a prefix
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
  EXPECT_EQ(in_quotes("a\033[1m\nb\x7f"), R"('a\x1b[1m\nb\x7f')");
  EXPECT_EQ(in_quotes(std::string(100, 'x')), "'" + std::string(60, 'x') + "...'");
  // the escaped length counts
  EXPECT_EQ(in_quotes(std::string(59, 'x') + "\n"), "'" + std::string(59, 'x') + "...'");
  EXPECT_EQ(in_quotes("é€😀"), "'é€😀'");
  // The 60th byte is within the é, which is dropped as a whole.
  EXPECT_EQ(in_quotes(std::string(59, 'x') + "é and more"), "'" + std::string(59, 'x') + "...'");
}

} // namespace
} // namespace rend::wording_test
