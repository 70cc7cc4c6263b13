#include "render/clip/frame_clock.h"

#include "sim/base/error.h"

#include <gtest/gtest.h>

namespace rend::frame_clock_test {
namespace {

TEST(FrameClock, ShowsTheFirstStateAtOrAfterAFrame) {
  const FrameClock clock(4, 1e-3, 30);
  EXPECT_EQ(clock.steps(), 4000);
  EXPECT_EQ(clock.frames(), 121);
  EXPECT_EQ(clock.step_of(0), 0);
  EXPECT_EQ(clock.step_of(1), 34); // 33.33 ms
  EXPECT_EQ(clock.step_of(3), 100);
  EXPECT_EQ(clock.step_of(120), 4000);
}

TEST(FrameClock, IsNotAStepLateByRounding) {
  for (const double step : {1e-4, 3e-4, 1.0 / 3000, 1.0 / 7000, 2.5e-5})
    for (const double fps : {24.0, 25.0, 30.0, 60.0}) {
      const FrameClock clock(100, step, fps);
      EXPECT_EQ(clock.frames(), static_cast<long>(100 * fps) + 1);
      for (long k = 0; k < clock.frames(); ++k) {
        const double at = static_cast<double>(clock.step_of(k)) * step, due = clock.time_of(k);
        EXPECT_GE(at, due * (1 - 1e-11)) << step << " " << fps << " " << k;
        EXPECT_LT(at - step, due * (1 - 1e-13)) << step << " " << fps << " " << k;
        if (k == 0) break; // frame 0 has only this condition
      }
      EXPECT_LE(clock.step_of(clock.frames() - 1), clock.steps());
    }
}

TEST(FrameClock, ShowsOneStateSeveralTimesWhereStepsAreLong) {
  const FrameClock clock(1, 0.1, 30);
  EXPECT_EQ(clock.frames(), 31);
  EXPECT_EQ(clock.step_of(1), 1);
  EXPECT_EQ(clock.step_of(2), 1);
  EXPECT_EQ(clock.step_of(3), 1);
  EXPECT_EQ(clock.step_of(4), 2);
}

TEST(FrameClock, HasOneFrameWhereNothingMoves) {
  const FrameClock clock(0, 1e-3, 30);
  EXPECT_EQ(clock.steps(), 0);
  EXPECT_EQ(clock.frames(), 1);
}

TEST(FrameClock, CountsAFrameAtTheEndAndNoneBehindIt) {
  EXPECT_EQ(FrameClock(0.3, 1e-3, 10).frames(), 4); // 0.3 * 10 is below 3 in doubles
  EXPECT_EQ(FrameClock(0.299, 1e-3, 10).frames(), 3);
}

// An eighth of real speed: frame 8 k is at the time of frame k, and its state is the same.
TEST(FrameClock, SlowMotionMakesMoreFramesOfTheSameSteps) {
  const FrameClock real(4, 1e-3, 30), slow(4, 1e-3, 30, Playback(0.125));
  EXPECT_EQ(slow.steps(), real.steps());
  EXPECT_EQ(slow.frames(), 961);
  EXPECT_DOUBLE_EQ(slow.clip_duration(), 32);
  for (long k = 0; k < real.frames(); ++k) {
    EXPECT_DOUBLE_EQ(slow.time_of(8 * k), real.time_of(k));
    EXPECT_EQ(slow.step_of(8 * k), real.step_of(k));
  }
}

// 1 s at 1, 1 s at a mean of 0.6 (from 1 to 0.2), the rest at 0.2.
TEST(FrameClock, FollowsKeysOfSpeed) {
  const FrameClock clock(3, 1e-4, 60, Playback(1, {{.at = 1, .speed = 1}, {.at = 2, .speed = 0.2}}));
  EXPECT_NEAR(clock.clip_duration(), 1 + 1 / 0.6 + 1 / 0.2, 1e-12);
  EXPECT_EQ(clock.frames(), 461); // 7.666 s
  EXPECT_EQ(clock.step_of(60), 10000);
  EXPECT_EQ(clock.step_of(160), 20000); // 2.666 s
  EXPECT_NEAR(clock.time_of(110), 1 + 0.8333333333 * (1 + 0.6) / 2, 1e-9);
  EXPECT_EQ(clock.step_of(460), 30000);
}

TEST(FrameClock, WithoutAShutterLooksAtNoMoments) {
  const FrameClock clock(4, 1e-3, 30);
  EXPECT_TRUE(clock.moments_of(7).empty());
  EXPECT_EQ(clock.first_step(7), clock.step_of(7));
}

TEST(FrameClock, MomentsAreTheMiddlesOfPartsOfTheTimeUntilTheFrame) {
  const FrameClock clock(4, 1e-5, 25, Playback(0.5), {.open = 0.5, .samples = 8});
  const auto moments = clock.moments_of(100); // at 4 s of the clip, 2 s; open for 20 ms of the clip, 10 ms
  ASSERT_EQ(moments.size(), 8u);
  for (std::size_t n = 0; n < 8; ++n) {
    EXPECT_NEAR(moments[n].time, 1.99 + 0.01 * (static_cast<double>(n) + 0.5) / 8, 1e-12);
    EXPECT_NEAR(static_cast<double>(moments[n].step) * 1e-5, moments[n].time, 1.0001e-5);
    EXPECT_GE(static_cast<double>(moments[n].step) * 1e-5, moments[n].time * (1 - 1e-11));
    EXPECT_EQ(moments[n].share, 1);
  }
  for (const Moment& moment : clock.moments_of(0)) EXPECT_EQ(moment.step, 0);
}

// Where steps are long, moments lie between states, never before that of the frame before.
TEST(FrameClock, MomentsLieBetweenStatesWhereStepsAreLong) {
  const FrameClock clock(4, 0.01, 30, Playback(), {.open = 1, .samples = 16});
  for (long frame = 1; frame < clock.frames(); ++frame) {
    const auto moments = clock.moments_of(frame);
    EXPECT_GE(clock.first_step(frame), clock.step_of(frame - 1));
    int between = 0;
    for (const Moment& moment : moments) {
      EXPECT_GE(moment.step, clock.step_of(frame - 1));
      EXPECT_LE(moment.step, clock.step_of(frame));
      if (moment.share == 1) continue;
      ++between;
      EXPECT_NEAR((static_cast<double>(moment.step - 1) + moment.share) * 0.01, moment.time, 1e-12);
    }
    EXPECT_GE(between, 8) << frame;
  }
}

std::vector<long> chosen(const std::string& text, long frames) {
  const FrameChoice choice(text);
  std::vector<long> out;
  for (long k = 0; k < frames; ++k)
    if (choice.has(k)) out.push_back(k);
  EXPECT_EQ(choice.last(frames), out.empty() ? -1 : out.back()) << text;
  return out;
}

TEST(FrameChoice, ReadsFramesRangesAndStrides) {
  EXPECT_EQ(chosen("7", 10), (std::vector<long>{7}));
  EXPECT_EQ(chosen("2-4", 10), (std::vector<long>{2, 3, 4}));
  EXPECT_EQ(chosen("1-9x3", 9), (std::vector<long>{1, 4, 7}));
  EXPECT_EQ(chosen("8-", 10), (std::vector<long>{8, 9}));
  EXPECT_EQ(chosen("0-x4", 10), (std::vector<long>{0, 4, 8}));
  EXPECT_EQ(chosen("0,5,8-20", 10), (std::vector<long>{0, 5, 8, 9}));
  EXPECT_EQ(chosen("50-60", 10), (std::vector<long>{}));
}

TEST(FrameChoice, OfAllHasAll) {
  EXPECT_TRUE(FrameChoice().has(12345));
  EXPECT_EQ(FrameChoice().last(10), 9);
}

TEST(FrameChoice, RefusesWhatIsNoList) {
  for (const char* text : {"", "x", "-", "-3", "3-1", "1x2", "1-5x0", "1-5x", "1,,2", "1,", "1 2", "1.5",
                           "0x10", "99999999999999999999", "1-2-3"}) {
    try {
      const FrameChoice choice(text);
      ADD_FAILURE() << text << " was taken";
    } catch (const UserError& error) {
      EXPECT_EQ(error.code, Exit::Usage) << text;
    }
  }
}

TEST(PictureSize, IsWidthTimesHeight) {
  EXPECT_EQ(parse_size("1280x720").width, 1280);
  EXPECT_EQ(parse_size("1280x720").height, 720);
  for (const char* text :
       {"", "1280", "1280x", "x720", "8x720", "1280x9000", "1280*720", "1280x720x3", "-64x64"})
    EXPECT_THROW(parse_size(text), UserError) << text;
}

} // namespace
} // namespace rend::frame_clock_test
