// The backdrop has no bands: the mean of 4 x 4 pixels is what the formula says, to a part of a level.
#include "render/draw/device.h"
#include "render/draw/renderer.h"
#include "tests/render/pictures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rend::dither_test {
namespace {

using namespace test;

constexpr int width = 640, height = 360;

// Of a grey backdrop, at a pixel from the top [levels]: shaders/common.glsl.
double backdrop(double grey, int x, int y) {
  const double right = 2 * (x + 0.5) / width - 1, up = 1 - 2 * (y + 0.5) / height - 0.15;
  return 255 * grey * std::sqrt(1 - 0.11 * right * right - 0.16 * up * up);
}

TEST(Dither, leaves_no_bands_in_the_backdrop) {
  const auto device = make_device();
  Frame frame = front_view();
  frame.bodies.clear();
  frame.background = {0.8f, 0.8f, 0.8f};
  Renderer renderer(width, height, 1);
  renderer.draw(frame);
  const Image image = renderer.read();
  double worst = 0, rounded = 0; // rounded: what a picture without the pattern would have
  for (int y = 0; y < height; y += 4)
    for (int x = 0; x < width; x += 4) {
      double mean = 0, wanted = 0, plain = 0;
      for (int n = 0; n < 16; ++n) {
        const double level = backdrop(0.8, x + n % 4, y + n / 4);
        mean += image.at(x + n % 4, y + n / 4)[0] / 16.0;
        wanted += level / 16;
        plain += std::round(level) / 16;
      }
      worst = std::max(worst, std::abs(mean - wanted));
      rounded = std::max(rounded, std::abs(plain - wanted));
    }
  EXPECT_LT(worst, 0.2);
  EXPECT_GT(rounded, 0.45);
}

} // namespace
} // namespace rend::dither_test
