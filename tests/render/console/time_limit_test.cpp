// A limit of time that holds for what never asks.
#include "render/console/time_limit.h"

#include "render/files/temporaries.h"
#include "sim/base/error.h"
#include "tests/render/pictures.h"

#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace rend::time_limit_test {
namespace {

TEST(TimeLimit, tells_what_is_left_and_fails_then) {
  const TimeLimit limit(0.05, "waiting", "wait less");
  EXPECT_GT(limit.left(), 0);
  limit.check();
  ::usleep(60'000);
  EXPECT_LT(limit.left(), 0);
  try {
    limit.check();
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::OutOfBudget);
    EXPECT_STREQ(error.what(), "waiting took longer than 0.05 s");
    EXPECT_EQ(error.hint, "wait less");
  }
}

TEST(TimeLimit, ends_the_program_that_does_not_ask) {
  const test::Folder folder;
  const std::string name = folder / "part";
  EXPECT_EXIT(
      {
        std::ofstream(name) << "a part";
        const TemporaryPath part(name.c_str());
        const TimeLimit limit(0.1, "waiting", "wait less");
        while (true) ::pause();
      },
      testing::ExitedWithCode(75), "waiting took longer than 0.1 s");
  EXPECT_EQ(folder.files(), 0);
}

TEST(TimeLimit, is_over_with_the_work) {
  EXPECT_EXIT(
      {
        for (int n = 0; n < 3; ++n) const TimeLimit limit(0.1, "waiting", "");
        ::usleep(600'000);
        ::_exit(0);
      },
      testing::ExitedWithCode(0), "");
}

} // namespace
} // namespace rend::time_limit_test
