#include "render/clip/frame_clock.h"

#include "sim/base/error.h"

#include <gtest/gtest.h>

namespace rend {
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
} // namespace rend
