// The line along torn edges in pictures of several heights.
#include "render/draw/device.h"
#include "render/draw/renderer.h"
#include "tests/render/pictures.h"

#include <gtest/gtest.h>

namespace rend::torn_line_test {
namespace {

using namespace test;

// In pictures of less than 120 rows it is thinner in proportion, so that it hides no more of the body.
TEST(TornLine, is_thinner_in_small_pictures) {
  const auto device = make_device();
  Frame frame = front_view();
  frame.bodies.push_back(screen(0, 0.5, grey, Line::Torn));
  frame.bodies[0].torn = {.colour = {0.02f, 0.05f, 1.0f}, .width = 32};
  const auto blue_rows = [&](int rows) {
    Renderer renderer(rows * 4 / 3, rows, 4);
    renderer.draw(frame);
    const Image image = renderer.read();
    int count = 0;
    for (int y = 0; y < rows; ++y) count += image.at(rows * 2 / 3, y)[2] > image.at(rows * 2 / 3, y)[0] + 60;
    return count;
  };
  // Half of a line at a border is drawn, along the upper edge and along the lower.
  EXPECT_NEAR(blue_rows(240), 2 * 8, 2);
  EXPECT_NEAR(blue_rows(120), 2 * 8, 2);
  EXPECT_NEAR(blue_rows(60), 2 * 4, 2);
  EXPECT_NEAR(blue_rows(30), 2 * 2, 2);
}

} // namespace
} // namespace rend::torn_line_test
