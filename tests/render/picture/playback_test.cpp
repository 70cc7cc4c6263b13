#include "render/picture/playback.h"

#include "sim/base/error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rend::playback_test {
namespace {

TEST(Playback, OfSpeedOneIsTheTimeOfTheSimulationToTheLastBit) {
  const Playback real;
  EXPECT_TRUE(real.is_real_time());
  for (double time = 0; time < 100; time += 0.37) {
    EXPECT_EQ(real.simulated(time), time);
    EXPECT_EQ(real.clip(time), time);
  }
}

TEST(Playback, SlowMotionTakesLonger) {
  const Playback slow(0.125);
  EXPECT_DOUBLE_EQ(slow.simulated(8), 1);
  EXPECT_DOUBLE_EQ(slow.clip(1), 8);
  EXPECT_FALSE(slow.is_real_time());
}

const std::vector<SpeedKey> keys{{.at = 0.2, .speed = 1}, {.at = 0.5, .speed = 0.1}, {.at = 1.5, .speed = 2}};

// Between two keys the mean speed is the mean of both, since it changes evenly: 0.3 s at 0.55, 1 s at 1.05.
TEST(Playback, KeysComeWhenTheMeanSpeedsSay) {
  const Playback played(1, keys);
  const double first = 0.2, second = first + 0.3 / 0.55, third = second + 1 / 1.05;
  EXPECT_NEAR(played.clip(0.1), 0.1, 1e-15);
  EXPECT_NEAR(played.clip(0.2), first, 1e-15);
  EXPECT_NEAR(played.clip(0.5), second, 1e-14);
  EXPECT_NEAR(played.clip(1.5), third, 1e-14);
  EXPECT_NEAR(played.clip(2.5), third + 0.5, 1e-14);
  EXPECT_DOUBLE_EQ(played.slowest(), 0.1);
}

// The integral by the rule of Simpson, over a speed that is drawn as straight lines over the time of the clip.
TEST(Playback, TheTimeOfTheSimulationIsTheIntegralOfTheSpeed) {
  const Playback played(1, keys);
  const double first = 0.2, second = first + 0.3 / 0.55, third = second + 1 / 1.05;
  const auto speed = [&](double clip) {
    if (clip <= first) return 1.0;
    if (clip <= second) return 1 + (0.1 - 1) * (clip - first) / (second - first);
    if (clip <= third) return 0.1 + (2 - 0.1) * (clip - second) / (third - second);
    return 2.0;
  };
  double time = 0;
  constexpr int steps = 20000;
  const double h = 2.5 / steps;
  for (int n = 0; n < steps; ++n) {
    time += h / 6 * (speed(n * h) + 4 * speed((n + 0.5) * h) + speed((n + 1) * h));
    const double clip = (n + 1) * h;
    ASSERT_NEAR(played.simulated(clip), time, 1e-8) << clip;
    ASSERT_NEAR(played.clip(played.simulated(clip)), clip, 1e-13) << clip;
    ASSERT_NEAR(played.speed_at(played.simulated(clip)), speed(clip), 1e-12) << clip;
  }
}

TEST(Playback, OfAKeyAtTheStartBeginsThere) {
  const Playback played(1, {{.at = 0, .speed = 0.5}, {.at = 1, .speed = 0.5}});
  EXPECT_DOUBLE_EQ(played.simulated(1), 0.5);
  EXPECT_DOUBLE_EQ(played.simulated(10), 5);
}

TEST(Playback, OneKeyIsTheSpeedOfAll) {
  const Playback played(1, {{.at = 3, .speed = 0.25}});
  EXPECT_DOUBLE_EQ(played.clip(1), 4);
  EXPECT_DOUBLE_EQ(played.clip(5), 20);
}

TEST(Playback, RefusesKeysOutOfOrder) {
  for (const double second : {1.0, 0.5})
    EXPECT_THROW(Playback(1, {{.at = 1, .speed = 1}, {.at = second, .speed = 0.5}}), UserError) << second;
}

} // namespace
} // namespace rend::playback_test
