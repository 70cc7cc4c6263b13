#include "sim/topology/marks.h"

#include <gtest/gtest.h>

namespace rend::marks_test {
namespace {

TEST(Marks, are_there_until_they_are_taken_away) {
  Marks marks;
  marks.fit(1000);
  EXPECT_FALSE(marks.has(999));
  EXPECT_TRUE(marks.insert(999));
  EXPECT_FALSE(marks.insert(999));
  marks.set(0);
  EXPECT_TRUE(marks.has(999) && marks.has(0));
  EXPECT_FALSE(marks.has(998) || marks.has(1));
  marks.clear_word(999);
  EXPECT_FALSE(marks.has(999));
  EXPECT_TRUE(marks.has(0));
}

TEST(Marks, stay_when_room_is_made_for_more) {
  Marks marks;
  marks.fit(10);
  marks.set(7);
  marks.fit(100000);
  EXPECT_TRUE(marks.has(7));
  EXPECT_FALSE(marks.has(99999));
}

} // namespace
} // namespace rend::marks_test
