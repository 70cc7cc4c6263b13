#include "sim/base/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <thread>

namespace rend {
namespace {

using namespace std::chrono_literals;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// However long the machine does something else in between.
TEST(Profile, gives_each_second_to_the_innermost_stage) {
  const auto before = Clock::now();
  Profile profile;
  double inside = 0;
  {
    const Within integration(&profile, Stage::Integration);
    const auto start = Clock::now();
    std::this_thread::sleep_for(5ms);
    {
      const Within forces(&profile, Stage::Forces);
      std::this_thread::sleep_for(20ms);
    }
    std::this_thread::sleep_for(5ms);
    inside = seconds_since(start);
  }
  const double all = seconds_since(before);
  const double forces = profile.spent(Stage::Forces).seconds,
               integration = profile.spent(Stage::Integration).seconds;
  EXPECT_GE(forces, 0.0199); // sleeping lasts at least so long, but for a reading
  EXPECT_GE(integration, 0.0099);
  EXPECT_LE(profile.total(), all);
  EXPECT_GE(forces + integration, inside - 3 * profile.reading() - 1e-9); // taken off; and rounding
  EXPECT_EQ(profile.spent(Stage::Integration).turns, 2);                  // there, and back to it
  EXPECT_EQ(profile.spent(Stage::Forces).turns, 1);
  EXPECT_EQ(profile.spent(Stage::Contact).turns, 0);
}

TEST(Profile, forgets_what_was_before) {
  Profile profile;
  {
    const Within guard(&profile, Stage::Guard);
    std::this_thread::sleep_for(2ms);
  }
  profile.restart();
  EXPECT_EQ(profile.total(), 0);
  EXPECT_EQ(profile.turn_to(Stage::Forces), Stage::Rest);
}

// Of many tries one at least is not interrupted.
TEST(Profile, takes_the_reading_of_the_clock_off) {
  Profile profile;
  EXPECT_GT(profile.reading(), 0);
  double least = 1;
  for (int tries = 0; tries < 50; ++tries) {
    profile.restart();
    for (int n = 0; n < 2000; ++n) const Within forces(&profile, Stage::Forces);
    least = std::min(least, profile.spent(Stage::Forces).seconds);
  }
  EXPECT_LT(least, 2000 * profile.reading()); // next to nothing was done
}

TEST(Profile, that_nobody_asks_for_is_no_profile) {
  const Within nothing(nullptr, Stage::Forces);
}

TEST(Profile, names_each_stage) {
  std::set<std::string> names;
  for (std::size_t n = 0; n < stage_count; ++n) names.insert(name_of(static_cast<Stage>(n)));
  EXPECT_EQ(names.size(), stage_count);
}

} // namespace
} // namespace rend
