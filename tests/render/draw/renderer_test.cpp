#include "render/draw/renderer.h"

#include "render/draw/device.h"
#include "render/files/png.h"
#include "sim/base/check.h"
#include "sim/base/error.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace rend::renderer_test {
namespace {

using namespace test;

constexpr int width = 160, height = 120;

class RendererTest : public testing::Test {
protected:
  static void SetUpTestSuite() { device_ = make_device(); }
  static void TearDownTestSuite() { device_.reset(); }

  Image picture(const Frame& frame, int samples = 4) {
    Renderer renderer(width, height, samples);
    renderer.draw(frame);
    return renderer.read();
  }

  // A cloth of many colours and lines over a floor, which uses every feature.
  static Frame rich_frame() {
    Frame frame = front_view();
    frame.camera.eye = {1, -3, 1.5};
    frame.floor = FrameFloor{-0.6};
    frame.bodies.push_back(screen(0, 0.5, red, Line::Cell));
    frame.bodies.push_back(table(0.2f, 0.4f, green));
    frame.obstacles.push_back(screen(0.4f, 0.3f, grey, Line::Torn));
    return frame;
  }

private:
  static inline std::unique_ptr<Device> device_;
};

TEST_F(RendererTest, ARedSquareInFrontOfTheCameraIsRedInTheMiddle) {
  for (const int samples : {1, 4}) {
    Frame frame = front_view();
    frame.bodies.push_back(screen(0, 0.5, red));
    const Image image = picture(frame, samples);
    const std::uint8_t* middle = image.at(width / 2, height / 2);
    EXPECT_GT(middle[0], 120);
    EXPECT_LT(middle[1], 90);
    EXPECT_LT(middle[2], 90);
  }
}

TEST_F(RendererTest, TheRightWayUp) {
  Frame frame = front_view();
  FrameBody body = screen(0, 0.2f, red);
  for (Corner& corner : body.corners) corner.position[2] += 0.8f; // up
  for (Corner& corner : body.corners) corner.position[0] -= 0.8f; // and to the left
  frame.bodies.push_back(body);
  const Image image = picture(frame);
  EXPECT_LT(image.at(width / 4, height / 6)[1], 100);
  EXPECT_GT(image.at(3 * width / 4, 5 * height / 6)[1], 180);
}

TEST_F(RendererTest, BothSidesOfASheetAreLitAndTheFarSideIsAShadeDarker) {
  Frame frame = front_view();
  frame.light = Eigen::Vector3d(0, -1, 1);
  frame.bodies.push_back(screen(0, 0.5, red)); // its normals point to -y, to the camera
  const int near = brightness(picture(frame), width / 2, height / 2);
  for (Corner& corner : frame.bodies[0].corners) corner.normal = {0, 1, 0};
  const int far = brightness(picture(frame), width / 2, height / 2);
  frame.bodies[0].shades_back = false;
  const int one_sided = brightness(picture(frame), width / 2, height / 2);
  EXPECT_LT(far, near - 10);
  EXPECT_GT(far, near / 2);
  EXPECT_NEAR(one_sided, near, 3);
}

TEST_F(RendererTest, OfASolidOnlyTheOutsideIsDrawn) {
  Frame frame = front_view();
  const Image empty = picture(frame);
  frame.bodies.push_back(screen(0, 0.5, red)); // winds around -y, towards the camera
  frame.bodies[0].two_sided = false;
  EXPECT_GT(largest_difference(picture(frame), empty), 100);
  for (std::size_t n = 0; n < 6; n += 3)
    std::swap(frame.bodies[0].corners[n + 1], frame.bodies[0].corners[n + 2]);
  EXPECT_LT(largest_difference(picture(frame), empty), 3);
  frame.bodies.push_back(screen(-0.2f, 0.2f, green)); // while sheets beside it show both sides
  for (std::size_t n = 0; n < 6; n += 3)
    std::swap(frame.bodies[1].corners[n + 1], frame.bodies[1].corners[n + 2]);
  EXPECT_GT(largest_difference(picture(frame), empty), 100);
}

TEST_F(RendererTest, ACreaseOfASolidIsALineThatGoesWithTheEdgesOfCells) {
  Frame frame = front_view();
  frame.bodies.push_back(screen(0, 0.5, grey, Line::Crease));
  const Image with = picture(frame);
  frame.bodies[0].edges = false;
  const Image without = picture(frame);
  frame.bodies[0] = screen(0, 0.5, grey, Line::None);
  EXPECT_GT(largest_difference(with, without), 20);
  EXPECT_EQ(largest_difference(picture(frame), without), 0);
}

TEST_F(RendererTest, WhatIsInFrontHidesWhatIsBehindInAnyOrder) {
  for (const bool swapped : {false, true}) {
    Frame frame = front_view();
    frame.bodies = {screen(-0.5, 0.4f, green), screen(0.5, 0.4f, red)};
    if (swapped) std::swap(frame.bodies[0], frame.bodies[1]);
    const Image image = picture(frame);
    const std::uint8_t* middle = image.at(width / 2, height / 2);
    EXPECT_GT(middle[1], middle[0] + 40);
  }
}

TEST_F(RendererTest, TheFloorIsDarkerInTheShadow) {
  Frame frame = front_view();
  frame.camera.eye = {0, -3, 4};
  frame.floor = FrameFloor{-0.5};
  frame.light = Eigen::Vector3d(-1, 0, 1); // from the left: the shadow falls to the right
  const Image empty = picture(frame);
  frame.bodies.push_back(table(0.3f, 0.4f, red));
  const Image image = picture(frame);
  int darkest = 0, left = 0;
  for (int x = 0; x < width; ++x) {
    const int loss = brightness(empty, x, height * 55 / 100) - brightness(image, x, height * 55 / 100);
    const bool body = image.at(x, height * 55 / 100)[0] > image.at(x, height * 55 / 100)[1] + 30;
    if (body) continue;
    if (x > width / 2) darkest = std::max(darkest, loss);
    if (x < width / 4) left = std::max(left, loss);
  }
  EXPECT_GT(darkest, 60);
  EXPECT_LT(left, 12);
}

TEST_F(RendererTest, ABodyThrowsItsShadowOnAnother) {
  Frame frame = front_view();
  frame.camera.eye = {0, -3, 3};
  frame.light = Eigen::Vector3d(0, 0, 1);
  frame.bodies.push_back(table(-0.3f, 1, grey));
  const int lit = brightness(picture(frame), width / 2, height * 6 / 10);
  FrameBody lid = table(2.5f, 0.6f, red); // above, out of the picture's middle
  frame.bodies.push_back(lid);
  const Image image = picture(frame);
  EXPECT_LT(brightness(image, width / 2, height * 6 / 10), lit - 60);
}

TEST_F(RendererTest, TheFloorIsDarkWhereABodyNearlyTouchesIt) {
  Frame frame = front_view();
  frame.camera.eye = {0, -3, 2};
  frame.floor = FrameFloor{0};
  frame.light =
      // from behind: the shadow falls towards the camera and covers nothing at x < 0
      Eigen::Vector3d(0, 1, 1.2);
  frame.bodies.push_back(table(0.02f, 0.4f, red));
  const Image near = picture(frame);
  frame.bodies[0] = table(1.0f, 0.4f, red);
  const Image high = picture(frame);
  const int x = width * 35 / 100, y = height / 2; // just beside the lid
  EXPECT_LT(brightness(near, x, y), brightness(high, x, y) - 10);
}

TEST_F(RendererTest, WhatIsUnderTheFloorIsNotSeenFromAbove) {
  Frame frame = front_view();
  frame.camera.eye = {0, -3, 3};
  frame.floor = FrameFloor{0};
  const Image empty = picture(frame);
  frame.bodies.push_back(table(-0.5f, 0.4f, red));
  EXPECT_LT(largest_difference(picture(frame), empty), 3);
}

TEST_F(RendererTest, FromBelowTheFloorIsNotThere) {
  Frame frame = front_view();
  frame.camera.eye = {0, -3, -2};
  const Image open = picture(frame);
  frame.floor = FrameFloor{0};
  EXPECT_EQ(picture(frame), open);
}

// The row of the brightest red in column x, within `margin` rows of y.
int warmest(const Image& image, int x, int y, int margin) {
  int best = y, most = -1000;
  for (int row = y - margin; row <= y + margin; ++row) {
    const int warm = image.at(x, row)[0] - image.at(x, row)[2];
    if (warm > most) most = warm, best = row;
  }
  return best;
}

TEST_F(RendererTest, ATornLineShowsAlongItsEdge) {
  Frame frame = front_view();
  frame.bodies.push_back(screen(0, 0.5, grey, Line::Torn));
  const Image image = picture(frame);
  const double tangent = std::tan(35 * 3.14159265 / 360);
  const int edge = static_cast<int>(height / 2 * (1 - 0.5 / 4 / tangent)); // the upper edge
  const int row = warmest(image, width / 2, edge, 5);
  EXPECT_NEAR(row, edge, 1);
  EXPECT_GT(image.at(width / 2, row)[0], image.at(width / 2, row)[2] + 40);
  // no line in the middle
  EXPECT_LT(image.at(width / 2, height / 2)[0], image.at(width / 2, height / 2)[2] + 20);
}

TEST_F(RendererTest, ATornLineHasTheColourAndWidthThatItIsGiven) {
  Frame frame = front_view();
  frame.bodies.push_back(screen(0, 0.5, grey));
  const Image plain = picture(frame);
  frame.bodies[0] = screen(0, 0.5, grey, Line::Torn);
  frame.bodies[0].torn.width = 0;
  EXPECT_EQ(picture(frame), plain);
  const auto blue_pixels = [&](float pixels) {
    frame.bodies[0].torn = {.colour = {0.02f, 0.05f, 1.0f}, .width = pixels};
    const Image image = picture(frame);
    int count = 0;
    for (int y = 0; y < height; ++y) count += image.at(width / 2, y)[2] > image.at(width / 2, y)[0] + 60;
    return count;
  };
  // Pictures this small take lines as at half of the height of 720; half of a line at a border is drawn.
  EXPECT_NEAR(blue_pixels(16), 2 * 4, 2);
  EXPECT_NEAR(blue_pixels(48), 2 * 12, 2);
}

TEST_F(RendererTest, EachBodyHasItsOwnTornLine) {
  Frame frame = front_view();
  frame.bodies.push_back(screen(0, 0.2f, grey, Line::Torn));
  frame.bodies.push_back(frame.bodies[0]);
  for (Corner& corner : frame.bodies[0].corners) corner.position[0] -= 0.4f;
  for (Corner& corner : frame.bodies[1].corners) corner.position[0] += 0.4f;
  const Image usual = picture(frame);
  frame.bodies[1].torn.colour = {0.02f, 0.05f, 1.0f};
  const Image one_blue = picture(frame);
  const auto half_differs = [&](int from, int until) {
    for (int y = 0; y < height; ++y)
      for (int x = from; x < until; ++x)
        if (!std::equal(usual.at(x, y), usual.at(x, y) + 3, one_blue.at(x, y))) return true;
    return false;
  };
  EXPECT_FALSE(half_differs(0, width / 2));
  EXPECT_TRUE(half_differs(width / 2, width));
}

TEST_F(RendererTest, LinesOfCellsAreDrawnOnlyWhereTheyAreWanted) {
  Frame frame = front_view();
  frame.bodies.push_back(screen(0, 0.5, grey));
  const Image plain = picture(frame);
  frame.bodies[0] = screen(0, 0.5, grey, Line::Cell);
  EXPECT_GT(largest_difference(picture(frame), plain), 12);
  frame.bodies[0].edges = false;
  EXPECT_EQ(picture(frame), plain);
  frame.bodies[0] = screen(0, 0.5, grey, Line::Border);
  frame.bodies[0].edges = false;
  EXPECT_GT(largest_difference(picture(frame), plain), 12);
}

TEST_F(RendererTest, LinesGoWhereCellsAreOnlyAFewPixelsWide) {
  Frame frame = front_view();
  frame.bodies.push_back(screen(0, 0.02f, grey));
  const Image plain = picture(frame);
  frame.bodies[0] = screen(0, 0.02f, grey, Line::Cell);
  EXPECT_LT(largest_difference(picture(frame), plain), 8);
}

TEST_F(RendererTest, FourSamplesSmoothAnEdge) {
  Frame frame = front_view();
  FrameBody body;
  add_triangle(body, {-0.8f, 0, -0.5f}, {0.8f, 0, -0.4f}, {0, 0, 0.7f}, {0, 0, 0, 255});
  frame.bodies.push_back(body);
  const auto between = [](const Image& image) { // intermediate pixels, neither dark nor light
    int count = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) count += image.at(x, y)[1] > 100 && image.at(x, y)[1] < 180;
    return count;
  };
  EXPECT_GT(between(picture(frame, 4)), between(picture(frame, 1)) + 40);
}

TEST_F(RendererTest, TheBackdropIsTheBackgroundInTheMiddleAndDarkerInTheCorners) {
  Frame frame = front_view();
  frame.background = {0.2f, 0.4f, 0.6f};
  const Image image = picture(frame);
  const std::uint8_t* middle = image.at(width / 2, height / 2);
  EXPECT_NEAR(middle[0], 51, 2);
  EXPECT_NEAR(middle[1], 102, 3);
  EXPECT_NEAR(middle[2], 153, 4);
  EXPECT_LT(brightness(image, 0, height - 1), brightness(image, width / 2, height / 2) - 10);
}

TEST_F(RendererTest, AFrameWithoutTrianglesIsDrawn) {
  Frame frame;
  EXPECT_EQ(picture(frame).width, width);
  frame.bodies.emplace_back();
  frame.floor = FrameFloor{};
  EXPECT_EQ(picture(frame).height, height);
}

TEST_F(RendererTest, TheSameFrameGivesTheSameBytesWhateverWasDrawnBefore) {
  Renderer renderer(width, height, 4);
  renderer.draw(rich_frame());
  const Image first = renderer.read();
  Frame other = rich_frame();
  other.bodies.push_back(screen(-0.3f, 2, green));
  renderer.draw(other);
  EXPECT_NE(renderer.read(), first);
  renderer.draw(rich_frame());
  EXPECT_EQ(renderer.read(), first);
  EXPECT_EQ(picture(rich_frame()), first);
}

TEST_F(RendererTest, NumbersThatAreNotFiniteAreNeverDrawn) {
  Renderer renderer(width, height, 1);
  Frame frame = rich_frame();
  frame.bodies[0].corners[1].position[0] = std::nanf("");
  EXPECT_THROW(renderer.draw(frame), InternalError);
  frame = rich_frame();
  frame.floor->z = std::nan("");
  EXPECT_THROW(renderer.draw(frame), InternalError);
  frame = rich_frame();
  frame.camera.target.y() = std::nan("");
  EXPECT_THROW(renderer.draw(frame), InternalError);
}

TEST_F(RendererTest, ASizeThatCannotBeDrawnIsTheUsersError) {
  EXPECT_THROW(Renderer(1'000'000, 10, 1), UserError);
  EXPECT_THROW(Renderer(0, 10, 1), UserError);
}

// llvmpipe reads the number of threads once per process, so each number needs a process: this test runs its own
// program again.
TEST_F(RendererTest, DISABLED_WritesAPicture) {
  write_png(std::getenv("REND_TEST_PICTURE"), picture(rich_frame()));
}

TEST_F(RendererTest, ThePictureIsTheSameForAnyNumberOfThreads) {
  NEEDS_PNG;
  const Folder folder;
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  for (const int threads : {0, 1, 3}) {
    const std::string path = (folder / fmt::format("{}.png", threads)).string();
    const std::string command = fmt::format(
        "env -u GTEST_TOTAL_SHARDS -u GTEST_SHARD_INDEX LP_NUM_THREADS={} REND_TEST_PICTURE={} '{}' "
        "--gtest_also_run_disabled_tests "
        "--gtest_filter=RendererTest.DISABLED_WritesAPicture > /dev/null 2>&1",
        threads, path, self);
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(read_png(path), picture(rich_frame())) << threads << " threads";
  }
}

// More samples bring the picture nearer to one that is rendered at four times the size and averaged.
TEST_F(RendererTest, SixteenSamplesAreTheMeanOfALargerPicture) {
  Frame frame = rich_frame();
  frame.occlusion = false;                               // its resolution does not depend on the samples
  for (auto* bodies : {&frame.bodies, &frame.obstacles}) // the width of lines depends on the picture's height
    for (FrameBody& body : *bodies)
      for (Corner& corner : body.corners) corner.line = {};
  const Image fine = picture(frame, 16);
  Renderer larger(2 * width, 2 * height, 4);
  larger.draw(frame);
  const Image large = larger.read();
  int worst = 0;
  for (int y = 2; y < height - 2; ++y)
    for (int x = 2; x < width - 2; ++x) {
      int low = 255, high = 0, sum = 0;
      for (int k = 0; k < 4; ++k) {
        const int value = large.at(2 * x + k % 2, 2 * y + k / 2)[0];
        low = std::min(low, value);
        high = std::max(high, value);
        sum += value;
      }
      if (high - low < 3) worst = std::max(worst, std::abs(fine.at(x, y)[0] - sum / 4));
    }
  EXPECT_LE(worst, 3);
}

TEST_F(RendererTest, ATransparentPictureHasNothingBehindItsBodies) {
  Frame frame = front_view();
  frame.transparent = true;
  frame.floor = FrameFloor{-0.6};
  frame.bodies.push_back(screen(0, 0.5, red));
  const Image image = picture(frame);
  ASSERT_EQ(image.channels, 4);
  EXPECT_EQ(image.at(2, 2)[3], 0);
  EXPECT_EQ(image.at(width / 2, height / 2)[3], 255);
  frame.transparent = false;
  const Image whole = picture(frame);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(image.at(width / 2, height / 2)[c], whole.at(width / 2, height / 2)[c]);
}

TEST_F(RendererTest, OneSeesThroughAWireFrameButNotThroughItsEdges) {
  Frame frame = front_view();
  FrameBody wires = screen(-0.2f, 0.5, green, Line::Border);
  wires.filled = false;
  frame.bodies.push_back(screen(0, 0.5, red));
  const Image behind = picture(frame);
  frame.bodies.push_back(wires);
  const Image both = picture(frame);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(both.at(width / 2, height / 2)[c], behind.at(width / 2, height / 2)[c]);
  EXPECT_NE(both, behind);
}

TEST_F(RendererTest, ASheetsFarSideHasItsOwnColour) {
  Frame frame = front_view();
  FrameBody body = screen(0, 0.5, red);
  body.back = {20, 40, 230};
  frame.bodies.push_back(body);
  frame.camera.eye = -frame.camera.eye; // from behind
  const Image back = picture(frame);
  frame.camera.eye = -frame.camera.eye;
  const Image front = picture(frame);
  const std::uint8_t *b = back.at(width / 2, height / 2), *f = front.at(width / 2, height / 2);
  EXPECT_TRUE((b[2] > 2 * b[0]) != (f[2] > 2 * f[0])); // one side is blue, the other red
  EXPECT_TRUE((b[0] > 2 * b[2]) != (f[0] > 2 * f[2]));
}

// The highlight is brighter the glossier the surface, and smaller the sharper.
TEST_F(RendererTest, AFinishChangesTheLightAndNotTheShape) {
  Frame frame = rich_frame();
  const Image cloth = picture(frame);
  for (const Finish& finish : finishes()) {
    for (FrameBody& body : frame.bodies) body.finish = finish;
    EXPECT_EQ(picture(frame) == cloth, finish.name == "cloth") << finish.name;
  }
}

} // namespace
} // namespace rend::renderer_test
