#include "render/draw/hud.h"

#include "render/draw/device.h"
#include "render/draw/renderer.h"
#include "tests/render/pictures.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace rend::hud_test {
namespace {

using namespace test;

HudContent rich_content() {
  HudContent content;
  content.title = "Ein Tuch – zerrissen, µ²";
  content.subtitle = "subtitle";
  content.figures = {"1.250 s", "12 tears"};
  HudPlot plot;
  plot.title = "energy";
  plot.curves = {{"kinetic", {255, 0, 0}, {0, 1, 2, 1}}, {"elastic", {0, 0, 255}, {0, -1, 0, 1}}};
  plot.low = -2;
  plot.high = 2;
  plot.low_text = "−2 J";
  plot.high_text = "2 J";
  plot.frames = 8;
  content.plots.push_back(plot);
  content.legends.push_back({"stress", "0", "2 kPa", {{0, 0, 0}, {0, 255, 0}, {255, 0, 255}}});
  return content;
}

class HudTest : public testing::Test {
protected:
  static void SetUpTestSuite() { device_ = make_device(); }
  static void TearDownTestSuite() { device_.reset(); }
  void SetUp() override {
    if (!hud_available()) GTEST_SKIP() << "built without the HUD";
  }

  static Image picture(int width, int height, const HudContent* content) {
    Frame frame = front_view();
    frame.bodies.push_back(screen(0, 0.5, green));
    Renderer renderer(width, height, 1);
    renderer.draw(frame);
    if (content != nullptr) {
      Hud hud(width, height);
      hud.draw(*content);
    }
    return renderer.read();
  }

  // The bounding box of the pixels that differ: left, top, right, bottom, as fractions of the picture.
  static std::array<double, 4> changed(const Image& a, const Image& b) {
    int left = a.width, top = a.height, right = 0, bottom = 0;
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x) {
        if (std::equal(a.at(x, y), a.at(x, y) + 3, b.at(x, y))) continue;
        left = std::min(left, x);
        right = std::max(right, x + 1);
        top = std::min(top, y);
        bottom = std::max(bottom, y + 1);
      }
    const double w = a.width, h = a.height;
    return {left / w, top / h, right / w, bottom / h};
  }

private:
  static inline std::unique_ptr<Device> device_;
};

TEST_F(HudTest, WritesInsideOfThePictureAndAlikeAtAnySize) {
  const HudContent content = rich_content();
  std::array<double, 4> first{};
  for (const int height : {360, 720, 1440}) {
    const int width = height * 16 / 9;
    const auto box = changed(picture(width, height, nullptr), picture(width, height, &content));
    EXPECT_GT(box[0], 0.005);
    EXPECT_GT(box[1], 0.01);
    EXPECT_LT(box[2], 0.995);
    EXPECT_LT(box[3], 0.99);
    if (height == 360) first = box;
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(box[k], first[k], 0.008);
  }
}

TEST_F(HudTest, EachPartStandsInItsCorner) {
  const Image bare = picture(640, 360, nullptr);
  const auto box_of = [&](const HudContent& content) { return changed(bare, picture(640, 360, &content)); };
  HudContent title, figures, plot, legend;
  title.title = "title";
  figures.figures = {"1 s"};
  plot.plots = rich_content().plots;
  legend.legends = rich_content().legends;
  EXPECT_LT(box_of(title)[2], 0.5);
  EXPECT_LT(box_of(title)[3], 0.5);
  EXPECT_GT(box_of(figures)[0], 0.5);
  EXPECT_LT(box_of(figures)[3], 0.5);
  EXPECT_LT(box_of(plot)[2], 0.5);
  EXPECT_GT(box_of(plot)[1], 0.5);
  EXPECT_GT(box_of(legend)[0], 0.5);
  EXPECT_GT(box_of(legend)[1], 0.5);
}

// Draws each part separately to find its box; all parts together change nothing outside of these boxes.
TEST_F(HudTest, NothingChangesOutsideOfItsBoxes) {
  const HudContent all = rich_content();
  std::array<HudContent, 4> parts;
  parts[0].title = all.title;
  parts[0].subtitle = all.subtitle;
  parts[1].figures = all.figures;
  parts[2].plots = all.plots;
  parts[3].legends = all.legends;
  constexpr int width = 640, height = 360;
  const Image bare = picture(width, height, nullptr), full = picture(width, height, &all);
  std::array<std::array<double, 4>, 4> boxes;
  double area = 0;
  for (std::size_t n = 0; n < 4; ++n) {
    boxes[n] = changed(bare, picture(width, height, &parts[n]));
    area += (boxes[n][2] - boxes[n][0]) * (boxes[n][3] - boxes[n][1]);
  }
  EXPECT_LT(area, 0.35); // of the picture
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double at_x = (x + 0.5) / width, at_y = (y + 0.5) / height;
      const bool inside = std::any_of(boxes.begin(), boxes.end(), [&](const auto& box) {
        return at_x > box[0] && at_y > box[1] && at_x < box[2] && at_y < box[3];
      });
      ASSERT_TRUE(inside || std::equal(bare.at(x, y), bare.at(x, y) + 3, full.at(x, y))) << x << ' ' << y;
    }
}

TEST_F(HudTest, ALegendShowsItsColoursFromLowToHigh) {
  HudContent content;
  content.legends = rich_content().legends;
  const Image image = picture(1280, 720, &content);
  std::vector<std::array<int, 3>> seen; // along each row, runs of the legend's own colours
  for (int y = 0; y < image.height && seen.size() != 3; ++y) {
    seen.clear();
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.at(x, y);
      const std::array<int, 3> colour{p[0], p[1], p[2]};
      const bool own =
          colour == std::array{0, 0, 0} || colour == std::array{0, 255, 0} || colour == std::array{255, 0, 255};
      if (own && (seen.empty() || seen.back() != colour)) seen.push_back(colour);
    }
  }
  const std::vector<std::array<int, 3>> expected{{0, 0, 0}, {0, 255, 0}, {255, 0, 255}};
  EXPECT_EQ(seen, expected);
}

TEST_F(HudTest, TheSameContentGivesTheSamePixels) {
  const HudContent content = rich_content();
  EXPECT_EQ(picture(640, 360, &content), picture(640, 360, &content));
}

TEST_F(HudTest, NothingToWriteChangesNothing) {
  const HudContent nothing;
  EXPECT_TRUE(nothing.empty());
  EXPECT_EQ(picture(320, 180, &nothing), picture(320, 180, nullptr));
}

} // namespace
} // namespace rend::hud_test
