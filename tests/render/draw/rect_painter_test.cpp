#include "render/draw/rect_painter.h"

#include "render/draw/device.h"
#include "tests/render/draw/drawing.h"

#include <fmt/format.h>
#include <random>

namespace rend::rect_painter_test {
namespace {

using namespace test;

class RectPainterTest : public testing::Test {
protected:
  static void SetUpTestSuite() { device_ = make_device(); }
  static void TearDownTestSuite() { device_.reset(); }

  // How often each pixel is drawn when the boxes are drawn one after another.
  static std::vector<int> drawn(RectPainter& boxes, const std::vector<PixelRect>& which, int width,
                                int height) {
    constexpr int once = 5;
    const Canvas canvas(width, height, {});
    const FragmentProgram count(
        fmt::format("out vec4 pixel; void main() {{ pixel = vec4({} / 255.0); }}", once).c_str());
    count.use();
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    boxes.draw(which, width, height);
    glDisable(GL_BLEND);
    std::vector<int> times;
    for (const Pixel& pixel : canvas.read()) {
      EXPECT_EQ(pixel[0] % once, 0);
      times.push_back(pixel[0] / once);
    }
    return times;
  }

  static std::vector<int> expected(const std::vector<PixelRect>& which, int width, int height) {
    std::vector<int> times(static_cast<std::size_t>(width * height));
    for (const PixelRect& box : which)
      for (int y = box.y; y < box.y + box.height; ++y)
        for (int x = box.x; x < box.x + box.width; ++x) ++times[static_cast<std::size_t>(y * width + x)];
    return times;
  }

private:
  static inline std::unique_ptr<Device> device_;
};

// Odd sizes, for which pixel coordinates are not exact; a row as wide as the largest picture.
TEST_F(RectPainterTest, CoverThePixelsThatWereAskedForAndNoOther) {
  std::mt19937 random(3);
  const auto up_to = [&](int most) { return std::uniform_int_distribution(0, most)(random); };
  RectPainter boxes;
  for (const auto& [width, height] : {std::pair(67, 45), {1, 1}, {128, 96}, {3839, 3}, {3, 2157}}) {
    std::vector<PixelRect> which;
    for (int n = 0; n < 40; ++n) {
      const int x = up_to(width - 1), y = up_to(height - 1);
      which.push_back({x, y, 1 + up_to(width - x - 1), 1 + up_to(height - y - 1)});
    }
    EXPECT_EQ(drawn(boxes, which, width, height), expected(which, width, height)) << width << " x " << height;
  }
}

TEST_F(RectPainterTest, NeighboursLeaveNoGapAndShareNoPixel) {
  constexpr int width = 101, height = 57;
  for (const int side : {1, 7, 32}) {
    std::vector<PixelRect> which;
    for (int y = 0; y < height; y += side)
      for (int x = 0; x < width; x += side)
        which.push_back({x, y, std::min(side, width - x), std::min(side, height - y)});
    RectPainter boxes;
    EXPECT_EQ(drawn(boxes, which, width, height), std::vector<int>(std::size_t{width} * height, 1)) << side;
  }
}

TEST_F(RectPainterTest, WhatWasDrawnBeforeIsNotDrawnAgain) {
  const std::vector<PixelRect> many{{0, 0, 5, 5}, {5, 5, 5, 5}, {2, 8, 3, 1}}, one{{7, 1, 2, 3}};
  RectPainter boxes;
  EXPECT_EQ(drawn(boxes, many, 10, 10), expected(many, 10, 10));
  EXPECT_EQ(drawn(boxes, one, 10, 10), expected(one, 10, 10));
  EXPECT_EQ(drawn(boxes, {}, 10, 10), std::vector<int>(100, 0));
}

} // namespace
} // namespace rend::rect_painter_test
