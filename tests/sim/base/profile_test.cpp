#include "sim/base/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <string>
#include <thread>

namespace rend::profile_test {
namespace {

using namespace std::chrono_literals;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// However long the thread is descheduled in between.
TEST(Profile, gives_each_second_to_the_innermost_phase) {
  const auto before = Clock::now();
  Profile profile(Profile::Extent::EveryStep);
  double inside = 0;
  {
    const PhaseScope integration(&profile, Phase::Integration);
    const auto start = Clock::now();
    std::this_thread::sleep_for(5ms);
    {
      const PhaseScope forces(&profile, Phase::Forces);
      std::this_thread::sleep_for(20ms);
    }
    std::this_thread::sleep_for(5ms);
    inside = seconds_since(start);
  }
  const double all = seconds_since(before);
  const double forces = profile.spent(Phase::Forces).seconds,
               integration = profile.spent(Phase::Integration).seconds;
  EXPECT_GE(forces, 0.0199); // sleeping lasts at least that long, up to the resolution of the clock
  EXPECT_GE(integration, 0.0099);
  EXPECT_LE(profile.total(), all);
  // the cost of reading the clock is subtracted; rounding
  EXPECT_GE(forces + integration, inside - 3 * profile.reading() - 1e-9);
  EXPECT_EQ(profile.spent(Phase::Integration).turns, 2); // entering and returning to it
  EXPECT_EQ(profile.spent(Phase::Forces).turns, 1);
  EXPECT_EQ(profile.spent(Phase::Contact).turns, 0);
}

TEST(Profile, forgets_what_was_before) {
  Profile profile(Profile::Extent::EveryStep);
  {
    const PhaseScope guard(&profile, Phase::Guard);
    std::this_thread::sleep_for(2ms);
  }
  profile.restart();
  EXPECT_EQ(profile.total(), 0);
  const PhaseScope forces(&profile, Phase::Forces);
  EXPECT_EQ(profile.spent(Phase::Forces).turns, 1);
  EXPECT_EQ(profile.spent(Phase::Guard).turns, 0);
}

// What is told, and two readings for each phase that was entered and left, is no more than went by. In one of
// many tries, since a reading that the processor shortens counts as nothing.
TEST(Profile, takes_the_reading_of_the_clock_off) {
  Profile profile(Profile::Extent::EveryStep);
  EXPECT_GT(profile.reading(), 0);
  constexpr int phases = 2000;
  double least_excess = 1;
  for (int tries = 0; tries < 50; ++tries) {
    const Clock::time_point begin = Clock::now();
    profile.restart();
    for (int n = 0; n < phases; ++n) const PhaseScope forces(&profile, Phase::Forces);
    const double whole = seconds_since(begin);
    EXPECT_GT(profile.total(), 0);
    least_excess = std::min(least_excess, profile.total() + 2 * phases * profile.reading() - whole);
  }
  EXPECT_LE(least_excess, 0);
}

TEST(Profile, that_nobody_asks_for_is_no_profile) {
  const PhaseScope nothing(nullptr, Phase::Forces);
}

TEST(Profile, times_one_step_in_sixteen_and_changes_of_topology_in_all) {
  Profile profile(Profile::Extent::SampledSteps);
  for (long step = 0; step < 32; ++step) {
    profile.begin_step(step);
    {
      const PhaseScope forces(&profile, Phase::Forces);
      const PhaseScope changes(&profile, Phase::Changes);
      const PhaseScope inside(&profile,
                              Phase::Forces); // nested: no time of its own in steps that are not sampled
    }
    profile.end_step();
  }
  // entering, and returning to it in the two sampled steps
  EXPECT_EQ(profile.spent(Phase::Changes).turns, 32 + 2);
  EXPECT_EQ(profile.spent(Phase::Forces).turns, 2 * 3);
  EXPECT_EQ(profile.seconds(Phase::Changes), profile.spent(Phase::Changes).seconds);
  EXPECT_DOUBLE_EQ(profile.seconds(Phase::Forces), 16 * profile.spent(Phase::Forces).seconds);
}

TEST(Profile, names_each_phase) {
  std::set<std::string> names;
  for (std::size_t n = 0; n < phase_count; ++n) names.insert(name_of(static_cast<Phase>(n)));
  EXPECT_EQ(names.size(), phase_count);
}

} // namespace
} // namespace rend::profile_test
