#include "render/console/progress.h"

#include <gmock/gmock.h>

namespace rend::progress_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const ProgressParts half{.share = 0.5,
                         .pieces = {"12 s left", "frame 30 of 60", "0.50 of 1.00 s", "20 ms/frame"}};

TEST(ProgressBar, fits_any_width) {
  for (std::size_t columns = 4; columns < 200; ++columns)
    EXPECT_LE(bar_line(half, columns, false).size(), columns) << columns;
}

TEST(ProgressBar, leaves_out_the_least_important_first) {
  EXPECT_EQ(bar_line(half, 4, false), " 50%");
  EXPECT_EQ(bar_line(half, 15, false), " 50%  12 s left");
  EXPECT_THAT(bar_line(half, 29, false), AllOf(HasSubstr("12 s left"), Not(HasSubstr("frame"))));
  EXPECT_THAT(bar_line(half, 59, false), AllOf(HasSubstr("frame 30 of 60"), HasSubstr("0.50 of 1.00 s")));
  EXPECT_THAT(bar_line(half, 119, false),
              AllOf(HasSubstr("20 ms/frame"), HasSubstr("============............ ")));
}

TEST(ProgressBar, has_a_bar_where_there_is_room) {
  EXPECT_THAT(bar_line(half, 29, false), HasSubstr("="));
  EXPECT_THAT(bar_line(half, 15, false), Not(HasSubstr("=")));
  EXPECT_THAT(bar_line(half, 59, true), HasSubstr("\033[36m"));
  EXPECT_THAT(bar_line(half, 59, false), Not(HasSubstr("\033")));
}

} // namespace
} // namespace rend::progress_test
