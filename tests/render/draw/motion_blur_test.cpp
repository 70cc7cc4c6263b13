#include "render/draw/motion_blur.h"

#include "render/draw/device.h"
#include "render/draw/renderer.h"
#include "tests/render/pictures.h"

#include <gtest/gtest.h>

namespace rend::motion_blur_test {
namespace {

using namespace test;

constexpr int width = 320, height = 160;

class MotionBlurTest : public testing::Test {
protected:
  static void SetUpTestSuite() { device_ = make_device(); }
  static void TearDownTestSuite() { device_.reset(); }

  static Image picture(const Frame& frame) {
    Renderer renderer(width, height, 4);
    renderer.draw(frame);
    return renderer.read();
  }
  // A square, moved to the right [m]; over nothing.
  static FrameState square(float right) {
    FrameState state;
    state.bodies.push_back(screen(0, 0.3f, red));
    for (Corner& corner : state.bodies[0].corners) corner.position[0] += right;
    return state;
  }
  static Frame transparent() {
    Frame frame = front_view();
    frame.transparent = true;
    return frame;
  }
  static FrameMoment at(const Frame& frame, std::size_t state) {
    return {.before = state, .after = state, .camera = frame.camera};
  }
  // Of the middle row: the columns that the square covers, as a sum of alphas.
  static double covered(const Image& image) {
    double sum = 0;
    for (int x = 0; x < width; ++x) sum += image.at(x, height / 2)[3] / 255.0;
    return sum;
  }
  // The columns between a share of `low` and one of 1 - low on the left side.
  static double ramp(const Image& image, double low) {
    int first = -1, last = -1;
    for (int x = 0; x < width; ++x) {
      const double alpha = image.at(x, height / 2)[3] / 255.0;
      if (first < 0 && alpha > low) first = x;
      if (last < 0 && alpha > 1 - low) last = x;
    }
    return last - first;
  }

private:
  static inline std::unique_ptr<Device> device_;
};

// What covers a column for a share of the time has that alpha: a ramp as wide as the way, and the sum of all
// alphas is the width of the square.
TEST_F(MotionBlurTest, OfASquareThatMovesEvenlyIsAsWideAsItsWay) {
  Frame still = transparent();
  still.bodies = square(0).bodies;
  const double wide = covered(picture(still)), pixels_a_metre = wide / 0.6;
  constexpr float way = 0.4f; // [m]
  for (const int samples : {8, 32}) {
    Frame frame = transparent();
    for (int n = 0; n < samples; ++n) {
      frame.states.push_back(
          square(way * ((static_cast<float>(n) + 0.5f) / static_cast<float>(samples) - 0.5f)));
      frame.moments.push_back(at(frame, frame.states.size() - 1));
    }
    const Image blurred = picture(frame);
    EXPECT_NEAR(covered(blurred), wide, 0.5) << samples;
    const double low = 0.5 / samples; // the first and the last stair
    EXPECT_NEAR(ramp(blurred, low), way * pixels_a_metre * (1 - 1.0 / samples), 1.5) << samples;
  }
}

TEST_F(MotionBlurTest, BetweenTwoStatesIsWhatLiesBetweenThem) {
  Frame two = transparent();
  two.states = {square(-0.2f), square(0.2f)};
  for (const double share : {0.125, 0.375, 0.625, 0.875})
    two.moments.push_back({.before = 0, .after = 1, .share = share, .camera = two.camera});
  Frame four = transparent();
  for (const float right : {-0.15f, -0.05f, 0.05f, 0.15f}) {
    four.states.push_back(square(right));
    four.moments.push_back(at(four, four.states.size() - 1));
  }
  const Image a = picture(two), b = picture(four);
  int different = 0;
  for (std::size_t n = 0; n < a.pixels.size(); ++n)
    different += std::abs(a.pixels[n] - b.pixels[n]) > 1 ? 1 : 0;
  EXPECT_LE(different, 8); // roundings of positions
}

TEST_F(MotionBlurTest, OfWhatDoesNotMoveIsThePlainPicture) {
  for (const bool over_nothing : {false, true}) {
    Frame plain = front_view();
    plain.transparent = over_nothing;
    plain.floor = FrameFloor{-0.6};
    plain.bodies.push_back(screen(0, 0.5, red, Line::Cell));
    plain.bodies.push_back(table(0.2f, 0.4f, green));
    Frame blurred = plain;
    blurred.states.push_back({.bodies = plain.bodies, .obstacles = {}});
    blurred.states.push_back(blurred.states.front());
    blurred.bodies.clear();
    for (const std::size_t state : {0, 1, 0}) blurred.moments.push_back(at(blurred, state));
    blurred.moments[1].weight = 5;
    EXPECT_TRUE(picture(blurred) == picture(plain)) << over_nothing;
  }
}

TEST_F(MotionBlurTest, KeepsTheShadowOnAFloorThatIsNotSeen) {
  Frame frame = front_view();
  frame.camera.eye = {0, -4, 3};
  frame.floor = FrameFloor{0};
  frame.transparent = frame.floor_shadow = true;
  frame.bodies.push_back(table(0.4f, 0.4f, red));
  Renderer renderer(96, 64, 4);
  renderer.draw(frame);
  const Image still = renderer.read();
  int shadow = 0;
  for (int y = 0; y < still.height; ++y)
    for (int x = 0; x < still.width; ++x) shadow += still.at(x, y)[3] > 20 && still.at(x, y)[0] == 0;
  EXPECT_GT(shadow, 50);
  frame.states.push_back({frame.bodies, {}, 0});
  frame.moments.assign(2, FrameMoment{.camera = frame.camera});
  frame.bodies.clear();
  renderer.draw(frame);
  EXPECT_LE(largest_difference(renderer.read(), still), 1);
}

TEST_F(MotionBlurTest, AMovingCameraBlursToo) {
  Frame frame = transparent();
  frame.states.push_back(square(0));
  for (const double left : {-0.1, 0.1}) {
    FrameMoment moment = at(frame, 0);
    moment.camera.eye.x() -= left;
    moment.camera.target.x() -= left;
    frame.moments.push_back(moment);
  }
  Frame still = transparent();
  still.bodies = square(0).bodies;
  EXPECT_GT(ramp(picture(frame), 0.2), ramp(picture(still), 0.2) + 5);
}

} // namespace
} // namespace rend::motion_blur_test
