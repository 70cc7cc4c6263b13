#include "sim/base/profile.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <thread>

namespace rend {
namespace {

using namespace std::chrono_literals;

TEST(Profile, gives_each_second_to_the_innermost_stage) {
  Profile profile;
  const auto start = std::chrono::steady_clock::now();
  {
    const Within integration(&profile, Stage::Integration);
    std::this_thread::sleep_for(5ms);
    {
      const Within forces(&profile, Stage::Forces);
      std::this_thread::sleep_for(20ms);
    }
    std::this_thread::sleep_for(5ms);
  }
  const double all = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double forces = profile.spent(Stage::Forces).seconds,
               integration = profile.spent(Stage::Integration).seconds;
  EXPECT_GE(forces, 0.0199); // sleeping lasts at least so long, but for a reading
  EXPECT_GE(integration, 0.0099);
  EXPECT_LE(profile.total(), all);
  EXPECT_NEAR(profile.total(), all, 1e-3);
  EXPECT_EQ(profile.spent(Stage::Integration).turns, 2); // there, and back to it
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

TEST(Profile, takes_the_reading_of_the_clock_off) {
  Profile profile;
  for (int n = 0; n < 100000; ++n) const Within forces(&profile, Stage::Forces);
  EXPECT_GT(profile.reading(), 0);
  EXPECT_LT(profile.spent(Stage::Forces).seconds, 100000 * profile.reading()); // next to nothing was done
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
