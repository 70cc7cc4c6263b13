// Rendering defects that occurred in this program or in others: each is injected into a picture of a preset, a
// frame of it or its scene, and must exceed the tolerances of the goldens. The unmodified picture must always
// pass.
#include "render/clip/session.h"
#include "render/compare/tolerances.h"
#include "render/draw/device.h"
#include "render/draw/renderer.h"
#include "render/picture/scene_picture.h"
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"
#include "tests/test_paths.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace rend::defects_test {
namespace {

namespace fs = std::filesystem;
const fs::path root = test::source_root;
constexpr int width = 240, height = 135; // of the goldens

// Frames 0 to `last` of a preset.
std::vector<Frame> frames_of(const std::string& preset, long last, const std::vector<std::string>& sets = {}) {
  SessionOptions options;
  options.preset = (root / "presets" / preset).string();
  options.sets = sets;
  options.quiet = true;
  Session session(options);
  FrameBuilder maker(session.picture(), session.scene(), static_cast<double>(width) / height,
                     session.clock().duration(), session.clock().frames());
  std::vector<Frame> frames;
  Session::Callbacks calls;
  calls.frame = [&](long frame) {
    maker.observe();
    frames.push_back(maker.draw(frame, session.clock().time_of(frame)));
  };
  session.run(last, calls);
  return frames;
}

constexpr const char* cloth = "tear/cloth-global-border.xml";
constexpr const char* bar = "fracture/pulled-bar.xml";
constexpr long cloth_frame = 15, bar_frame = 2; // the cloth has torn in frame 15

class Defects : public testing::Test {
protected:
  static void SetUpTestSuite() {
    device_ = make_device();
    renderer_ = std::make_unique<Renderer>(width, height, 4);
    frames_ = frames_of(cloth, cloth_frame);
    solid_ = frames_of(bar, bar_frame);
  }
  static void TearDownTestSuite() {
    frames_.clear();
    solid_.clear();
    renderer_.reset();
    device_.reset();
  }

  static Image drawn(const Frame& frame) {
    renderer_->draw(frame);
    return renderer_->read();
  }
  static Picture picture(const Image& image) {
    HighDepthImage deep;
    deep.width = image.width;
    deep.height = image.height;
    deep.channels = image.channels;
    deep.samples.assign(image.pixels.begin(), image.pixels.end());
    return picture_of(deep);
  }
  static bool passes(const Image& expected, const Image& now) {
    static const Tolerances tolerances(root / "tests/goldens/tolerances.xml");
    const Tolerance tolerance = tolerances.of("tear/cloth-global-border-15.png").tolerance;
    return excesses(tolerance, measure(picture(expected), picture(now), {}, {})).empty();
  }

  static const Frame& torn() { return frames_.back(); }
  static const Frame& solid() { return solid_.back(); }

  // The defect is injected into the picture, the torn cloth's frame, the bar's frame, or the cloth's preset.
  void expect_caught(const char* what, const std::function<void(Image&)>& defect) {
    const Image good = drawn(torn());
    Image bad = good;
    defect(bad);
    EXPECT_FALSE(passes(good, bad)) << what;
    ++count_;
  }
  void expect_caught_in_frame(const char* what, const Frame& frame, const std::function<void(Frame&)>& defect) {
    Frame bad = frame;
    defect(bad);
    EXPECT_FALSE(passes(drawn(frame), drawn(bad))) << what;
    ++count_;
  }
  void expect_caught_in_scene(const char* what, const std::vector<std::string>& sets) {
    EXPECT_FALSE(passes(drawn(torn()), drawn(frames_of(cloth, cloth_frame, sets).back()))) << what;
    ++count_;
  }

  static std::unique_ptr<Device> device_;
  static std::unique_ptr<Renderer> renderer_;
  static std::vector<Frame> frames_, solid_;
  int count_ = 0;
};
std::unique_ptr<Device> Defects::device_;
std::unique_ptr<Renderer> Defects::renderer_;
std::vector<Frame> Defects::frames_, Defects::solid_;

void each_level(Image& image, const std::function<double(double)>& curve) {
  for (std::uint8_t& level : image.pixels)
    level = static_cast<std::uint8_t>(std::clamp(std::lround(curve(level)), 0L, 255L));
}

// The middle of the picture shows the cloth.
std::uint8_t* middle(Image& image) {
  return image.row(image.height / 2) + static_cast<std::size_t>(3) * (image.width / 2);
}

void shift(Image& image, std::ptrdiff_t bytes) {
  std::rotate(image.pixels.begin(), image.pixels.end() - bytes, image.pixels.end());
}

TEST_F(Defects, of_pictures_are_caught) {
  expect_caught("all shifted by a pixel to the right", [](Image& i) { shift(i, 3); });
  expect_caught("all shifted by a row", [](Image& i) { shift(i, static_cast<std::ptrdiff_t>(i.stride())); });
  expect_caught("one pixel shifted", [](Image& i) {
    // At the first edge in the picture.
    for (std::size_t n = 0; n + 3 < i.pixels.size(); n += 3)
      if (std::abs(i.pixels[n] - i.pixels[n + 3]) > 20)
        return void(std::swap_ranges(&i.pixels[n], &i.pixels[n + 3], &i.pixels[n + 3]));
  });
  expect_caught("one pixel two levels off",
                [](Image& i) { middle(i)[1] = static_cast<std::uint8_t>(middle(i)[1] ^ 2); });
  expect_caught("gamma of 1.02",
                [](Image& i) { each_level(i, [](double v) { return 255 * std::pow(v / 255, 1 / 1.02); }); });
  expect_caught("linear written as sRGB",
                [](Image& i) { each_level(i, [](double v) { return 255 * std::pow(v / 255, 2.2); }); });
  expect_caught("all one level brighter", [](Image& i) { each_level(i, [](double v) { return v + 1; }); });
  expect_caught("less contrast by one percent",
                [](Image& i) { each_level(i, [](double v) { return 127.5 + 0.99 * (v - 127.5); }); });
  expect_caught("red and blue exchanged", [](Image& i) {
    for (std::size_t n = 0; n < i.pixels.size(); n += 3) std::swap(i.pixels[n], i.pixels[n + 2]);
  });
  expect_caught("upside down", [](Image& i) {
    for (int y = 0; y < i.height / 2; ++y)
      std::swap_ranges(i.row(y), i.row(y) + i.stride(), i.row(i.height - 1 - y));
  });
  expect_caught("a row twice", [](Image& i) { std::copy_n(i.row(44), i.stride(), i.row(45)); });
  expect_caught("the last rows not read", [](Image& i) {
    std::fill(i.pixels.end() - static_cast<std::ptrdiff_t>(2 * i.stride()), i.pixels.end(), 0);
  });
  expect_caught("6 bits a channel",
                [](Image& i) { each_level(i, [](double v) { return 4 * std::floor(v / 4) + 2; }); });
  EXPECT_EQ(count_, 13);
}

void each_corner(Frame& frame, const std::function<void(Corner&)>& action) {
  for (Corner& corner : frame.bodies.at(0).corners) action(corner);
}

TEST_F(Defects, of_frames_surfaces_are_caught) {
  const auto caught = [&](const char* what, const auto& defect) {
    expect_caught_in_frame(what, torn(), defect);
  };
  caught("a lost triangle", [](Frame& f) {
    f.bodies[0].corners.erase(f.bodies[0].corners.begin() + 90, f.bodies[0].corners.begin() + 93);
  });
  caught("a lost body", [](Frame& f) { f.bodies.clear(); });
  caught("the surface from before the tear", [](Frame& f) {
    // Corners of the old surface move along, but the torn edges stay connected: as if the surface had not been
    // rebuilt.
    const auto first = std::find_if(frames_.rbegin(), frames_.rend(), [](const Frame& old) {
      const auto& corners = old.bodies[0].corners;
      return std::none_of(corners.begin(), corners.end(), [](const Corner& c) {
        return std::find(c.line.begin(), c.line.end(), static_cast<std::uint8_t>(Line::Torn)) != c.line.end();
      });
    });
    ASSERT_NE(first, frames_.rend());
    f.bodies = first->bodies;
  });
  caught("the bodies of the frame before", [](Frame& f) { f.bodies = frames_[frames_.size() - 2].bodies; });
  caught("mirrored", [](Frame& f) { each_corner(f, [](Corner& c) { c.position[0] = -c.position[0]; }); });
  expect_caught_in_frame("triangles wound the wrong way", solid(), [](Frame& f) {
    auto& corners = f.bodies[0].corners;
    for (std::size_t n = 0; n < corners.size(); n += 3) std::swap(corners[n + 1], corners[n + 2]);
  });
  EXPECT_EQ(count_, 6);
}

void replace_lines(Frame& frame, Line from, Line to) {
  each_corner(frame, [&](Corner& c) {
    std::replace(c.line.begin(), c.line.begin() + 3, static_cast<std::uint8_t>(from),
                 static_cast<std::uint8_t>(to));
  });
}

TEST_F(Defects, of_frames_lines_and_shades_are_caught) {
  const auto caught = [&](const char* what, const auto& defect) {
    expect_caught_in_frame(what, torn(), defect);
  };
  caught("torn edges without their lines", [](Frame& f) { replace_lines(f, Line::Torn, Line::None); });
  caught("diagonals of quads as edges", [](Frame& f) { replace_lines(f, Line::None, Line::Cell); });
  caught("no edges", [](Frame& f) { f.bodies[0].edges = false; });
  caught("flat triangles", [](Frame& f) { each_corner(f, [](Corner& c) { c.normal = {0, 0, 0}; }); });
  caught("another colour, four levels off", [](Frame& f) {
    each_corner(f, [](Corner& c) { c.colour[1] = static_cast<std::uint8_t>(c.colour[1] + 4); });
  });
  expect_caught_in_frame("a swapped normal", solid(), [](Frame& f) {
    // A visible triangle: one at the front, in the middle.
    auto& corners = f.bodies[0].corners;
    for (std::size_t n = 0; n < corners.size(); n += 3)
      if (corners[n].normal[1] < -0.9f) {
        for (std::size_t k = 0; k < 3; ++k) corners[n + k].normal = {0, 0, 1};
        return;
      }
  });
  EXPECT_EQ(count_, 6);
}

TEST_F(Defects, of_what_is_around_bodies_are_caught) {
  const auto caught = [&](const char* what, const auto& defect) {
    expect_caught_in_frame(what, torn(), defect);
  };
  caught("no floor", [](Frame& f) { f.floor.reset(); });
  caught("the floor a centimetre lower", [](Frame& f) { f.floor->z -= 0.01; });
  caught("an angle of view half a degree wider", [](Frame& f) { f.camera.fov += 0.5; });
  caught("the camera a centimetre aside", [](Frame& f) { f.camera.eye.x() += 0.01; });
  caught("another background", [](Frame& f) { f.background[2] -= 0.02f; });
  caught("light from elsewhere", [](Frame& f) { f.light = Eigen::Vector3d(-1, 0, 1); });
  EXPECT_EQ(count_, 6);
  Renderer coarse(width, height, 1);
  coarse.draw(torn());
  EXPECT_FALSE(passes(drawn(torn()), coarse.read())) << "edges that are not smoothed";
}

TEST_F(Defects, of_scenes_are_caught) {
  expect_caught_in_scene("a threshold 20 % higher", {"body.tear.threshold=0.144"});
  expect_caught_in_scene("no law of tearing before the end", {"body.tear.until=0.01"});
  expect_caught_in_scene("gravity one percent less", {"world.gravity=0 0 -9.71"});
  expect_caught_in_scene("springs one percent stiffer", {"body.springs.stretch.k=60.6"});
  expect_caught_in_scene("another pattern of cells", {"body.sheet.pattern=triangles"});
  expect_caught_in_scene("without the air", {"body.viscosity.value=0"});
  EXPECT_EQ(count_, 6);
}

TEST_F(Defects, are_not_seen_where_there_is_none) {
  const Image good = drawn(torn());
  EXPECT_TRUE(passes(good, good));
  EXPECT_TRUE(passes(good, drawn(torn())));
}

// End to end, from the preset to the file and through `rend diff`; 200 times with REND_WHOLE in the
// environment.
TEST(RepeatedRenders, raise_no_false_alarm) {
  NEEDS_PNG;
  const program::TestFolder place;
  const std::string render =
      "render '" + (root / "presets" / cloth).string() + "' --frames 15 --size 240x135 -q -o ";
  ASSERT_EQ(place.rend(render + "first").code, 0);
  const int turns = std::getenv("REND_WHOLE") ? 200 : 5;
  for (int turn = 0; turn < turns; ++turn) {
    // As on other machines: other numbers of threads and vector widths of llvmpipe.
    const std::string threads = std::to_string(1 + turn % 4), width_of_vectors = turn % 2 ? "128" : "256";
    const auto rendered = place.shell("LP_NATIVE_VECTOR_WIDTH=" + width_of_vectors +
                                      " LP_NUM_THREADS=" + std::to_string(turn % 3) + " " + test::rend_program +
                                      " " + render + "again --threads " + threads);
    ASSERT_EQ(rendered.code, 0) << rendered.err;
    const auto outcome =
        place.rend("diff first again -t '" + (root / "tests/goldens/tolerances.xml").string() + "'");
    ASSERT_EQ(outcome.code, 0) << "turn " << turn << ": " << outcome.out;
  }
}

} // namespace
} // namespace rend::defects_test
