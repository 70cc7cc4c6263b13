// How long a run takes, from its first steps.
#include "render/clip/run_estimate.h"

#include "tests/render/commands/program_run.h"

#include <gmock/gmock.h>

#include <regex>

namespace rend::run_estimate_test {
namespace {

using testing::HasSubstr;
using testing::Not;

// What is told, and after which step; all steps take the same time, but for the first.
struct Told {
  double seconds = 0;
  long step = 0; // 0: nothing was told
};
Told told(long steps, double seconds, double first) {
  RunEstimate estimate(steps);
  Told all;
  for (long n = 1; n <= std::min(steps, 10000L); ++n)
    if (const auto left = estimate.add(n == 1 ? first : seconds)) {
      EXPECT_EQ(all.step, 0) << "once";
      all = {*left, n};
    }
  return all;
}

TEST(RunEstimate, is_the_time_of_a_step_times_the_steps_that_are_left) {
  const Told run = told(1000000, 0.01, 0.5); // the first step is not counted
  EXPECT_GE(run.step, 100);
  EXPECT_LE(run.step, 102);
  EXPECT_NEAR(run.seconds, 0.01 * static_cast<double>(1000000 - run.step), 1e-6);
}

TEST(RunEstimate, tells_no_run_of_less_than_an_hour) {
  EXPECT_EQ(told(350000, 0.01, 0.01).step, 0);
  EXPECT_GT(told(370000, 0.01, 0.01).step, 0);
}

TEST(RunEstimate, waits_for_no_second_step_where_the_first_takes_long) {
  const Told run = told(100, 60, 60);
  EXPECT_EQ(run.step, 1);
  EXPECT_DOUBLE_EQ(run.seconds, 99 * 60.0);
}

TEST(RunEstimate, is_told_in_hours) {
  EXPECT_EQ(hours_in_words(3600), "1.0 hours");
  EXPECT_EQ(hours_in_words(10 * 3600), "10 hours");
  EXPECT_EQ(hours_in_words(1138.4 * 3600), "1138 hours (47 days)");
}

// Of 1e11 steps: at a nanosecond each, still more than a minute; this program takes more than 36 ns.
TEST(RunEstimate, is_told_by_the_program_within_the_first_seconds) {
  const program::TestFolder place;
  std::string text = program::pulled;
  text.replace(text.find("duration=\"0.3\""), 14, "duration=\"1e8\"");
  place.write("long.xml", text);
  const auto run = place.shell("timeout --preserve-status -s INT 5 " + std::string(test::rend_program) +
                               " run long.xml --fps 0.01");
  EXPECT_EQ(run.code, 130) << run.err;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(run.err, found, std::regex("this run takes about ([0-9]+) hours"))) << run.err;
  EXPECT_GT(std::stod(found[1]), 1);
  EXPECT_THAT(run.err, HasSubstr("steps of 0.001 s"));
  EXPECT_THAT(place.rend("run long.xml --steps 200").err, Not(HasSubstr("this run takes about")));
}

} // namespace
} // namespace rend::run_estimate_test
