// Pictures on bodies, against what their pixels are by formula: a square that fills a known part of the
// picture, lit as a plain grey one is, with the picture sampled here.
#include "render/draw/device.h"
#include "render/draw/renderer.h"
#include "tests/render/pictures.h"

#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace rend::textured_body_test {
namespace {

using namespace test;

constexpr int side = 128;           // [pixels] of the picture
constexpr float half = 0.5f;        // of the square [m]
constexpr double share = 0.75;      // of the picture's width that the square takes
constexpr std::uint8_t plain = 128; // grey

double light_of(double number) {
  return number <= 0.04045 ? number / 12.92 : std::pow((number + 0.055) / 1.055, 2.4);
}
double number_of(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

Image painted(int width, int height, const std::function<Colour(int x, int y)>& colour) {
  Image image(width, height, 4);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (std::size_t c = 0; c < 4; ++c) image.row(y)[4 * x + static_cast<int>(c)] = colour(x, y)[c];
  return image;
}

class TexturedBody : public testing::Test {
protected:
  static void SetUpTestSuite() { device_ = make_device(); }
  static void TearDownTestSuite() { device_.reset(); }

  static Image picture(const Frame& frame) {
    Renderer renderer(side, side, 4);
    renderer.draw(frame);
    return renderer.read();
  }

  // The square faces the camera, which is far away; without highlights light multiplies colours.
  static Frame view() {
    Frame frame = front_view();
    frame.camera.eye = {0, -100, 0};
    frame.camera.fov = 2 * 180 / M_PI * std::atan(half / share / 100);
    frame.light = Eigen::Vector3d(-0.5, -0.6, 1);
    FrameBody body = screen(0, half, {plain, plain, plain, 255});
    body.finish = Finish{.name = "flat", .what = "", .gloss = 0, .rim = 0};
    body.edges = false;
    body.shades_back = true;
    frame.bodies.push_back(body);
    return frame;
  }

  static Frame with_picture(const std::shared_ptr<const Texture>& texture, Wrap wrap = Wrap::Clamp,
                            double repeats = 1) {
    Frame frame = view();
    FrameBody& body = frame.bodies.front();
    body.texture = {texture, nullptr, wrap, 1};
    for (const Corner& corner : body.corners)
      body.texture_points.push_back({static_cast<float>(repeats * (corner.position[0] / (2 * half) + 0.5)),
                                     static_cast<float>(repeats * (corner.position[2] / (2 * half) + 0.5))});
    return frame;
  }

  // Places in the square, 0 to 1 to the right and down, of the middle of a pixel.
  static double across(int pixel) { return ((pixel + 0.5) / side - 0.5) / share + 0.5; }
  static bool is_inside(int pixel) { return across(pixel) > 0.02 && across(pixel) < 0.98; }

  // What the lights make of the number of a colour there, by the plain square.
  static double factor(const Image& lit, int x, int y, int c) { return lit.at(x, y)[c] / double{plain}; }

private:
  static inline std::unique_ptr<Device> device_;
};

int middle(const Image& image, int x, int c) {
  return image.at(x, side / 2)[c];
}

// Bilinear, in the shaders' light: squares of sRGB numbers. In texels from the top left corner; clamped.
double sampled(const Image& image, double x, double y, int c) {
  const auto light = [&](int i, int j) {
    const double number =
        image.at(std::clamp(i, 0, image.width - 1), std::clamp(j, 0, image.height - 1))[c] / 255.0;
    return number * number;
  };
  const double i = std::floor(x - 0.5), j = std::floor(y - 0.5), s = x - 0.5 - i, t = y - 0.5 - j;
  const int a = static_cast<int>(i), b = static_cast<int>(j);
  return (1 - t) * ((1 - s) * light(a, b) + s * light(a + 1, b)) +
         t * ((1 - s) * light(a, b + 1) + s * light(a + 1, b + 1));
}

TEST_F(TexturedBody, a_magnified_picture_is_interpolated_in_light_upright) {
  const Image image = painted(8, 8, [](int x, int y) {
    return Colour{static_cast<std::uint8_t>(10 + 20 * x), static_cast<std::uint8_t>((x + y) % 2 * 150),
                  static_cast<std::uint8_t>(20 * y), 255};
  });
  const Image lit = picture(view()), now = picture(with_picture(make_texture(image)));
  double sum = 0;
  int count = 0;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      if (!is_inside(x) || !is_inside(y)) continue;
      for (int c = 0; c < 3; ++c) {
        const double number = 255 * std::sqrt(sampled(image, 8 * across(x), 8 * across(y), c));
        const double expected = number * factor(lit, x, y, c);
        EXPECT_NEAR(now.at(x, y)[c], std::min(expected, 255.0), 6) << x << ", " << y << ", " << c;
        sum += std::abs(now.at(x, y)[c] - std::min(expected, 255.0));
        ++count;
      }
    }
  EXPECT_GT(count, 20000);
  EXPECT_LT(sum / count, 1);
}

TEST_F(TexturedBody, a_plain_picture_looks_as_the_plain_colour_does) {
  for (const int number : {8, 40, 128, 170}) {
    const auto level = static_cast<std::uint8_t>(number);
    const Image texture = painted(3, 5, [&](int, int) { return Colour{level, level, level, 255}; });
    Frame colour = view();
    for (Corner& corner : colour.bodies[0].corners) corner.colour = {level, level, level, 255};
    EXPECT_LE(largest_difference(picture(with_picture(make_texture(texture))), picture(colour)), 2) << number;
  }
}

// A checker of single pixels, so small that each pixel shows many: not the mean of numbers, which is 90, but
// that of light.
TEST_F(TexturedBody, a_minified_picture_is_the_mean_of_its_light) {
  const Image checker = painted(1024, 1024, [](int x, int y) {
    const std::uint8_t level = (x + y) % 2 == 0 ? 180 : 0;
    return Colour{level, level, level, 255};
  });
  const double mean = 255 * number_of(light_of(180 / 255.0) / 2);
  ASSERT_GT(mean, 125);
  const Image lit = picture(view()), now = picture(with_picture(make_texture(checker)));
  for (int y = 0; y < side; y += 3)
    for (int x = 0; x < side; x += 3) {
      if (!is_inside(x) || !is_inside(y)) continue;
      EXPECT_NEAR(now.at(x, y)[1], mean * factor(lit, x, y, 1), 3) << x << ", " << y;
    }
}

TEST_F(TexturedBody, a_ramp_is_the_same_ramp_on_every_level) {
  const Image ramp = painted(512, 512, [](int x, int) {
    const auto level = static_cast<std::uint8_t>(20 + x / 4);
    return Colour{level, level, level, 255};
  });
  const Image lit = picture(view()), now = picture(with_picture(make_texture(ramp)));
  for (int x = 0; x < side; ++x) { // a ramp is the same on all levels
    if (across(x) < 0.05 || across(x) > 0.95) continue;
    EXPECT_NEAR(now.at(x, side / 2)[0], (20 + 128 * across(x)) * factor(lit, x, side / 2, 0), 3) << x;
  }
}

TEST_F(TexturedBody, goes_on_beyond_its_sides_as_asked) {
  // black to the left, bright to the right
  const Image halves = painted(64, 64, [](int x, int) {
    const std::uint8_t level = x < 32 ? 0 : 170;
    return Colour{level, level, level, 255};
  });
  const auto row = [&](Wrap wrap) { // at 1/8, 3/8, 5/8, 7/8 of twice the picture
    const Image now = picture(with_picture(make_texture(halves), wrap, 2));
    std::string out;
    for (const double at : {0.125, 0.375, 0.625, 0.875})
      out += now.at(static_cast<int>(side * ((at - 0.5) * share + 0.5)), side / 2)[0] > 60 ? '1' : '0';
    return out;
  };
  EXPECT_EQ(row(Wrap::Repeat), "0101");
  EXPECT_EQ(row(Wrap::Clamp), "0111");
  EXPECT_EQ(row(Wrap::Mirror), "0110");
}

// Red on the left half: of the back as well, for who looks at the back.
TEST_F(TexturedBody, the_back_has_its_own_picture_or_colour_or_a_shade_of_the_front) {
  const auto front = make_texture(painted(2, 1, [](int x, int) {
    return x == 0 ? Colour{180, 0, 0, 255} : Colour{0, 0, 180, 255};
  }));
  const auto green = make_texture(painted(2, 1, [](int x, int) {
    return x == 0 ? Colour{0, 180, 0, 255} : Colour{0, 0, 0, 255};
  }));
  Frame frame = with_picture(front);
  const auto left = [&](int c) { return middle(picture(frame), side / 4, c); };
  const auto right = [&](int c) { return middle(picture(frame), 3 * side / 4, c); };
  EXPECT_GT(left(0), 100);
  EXPECT_LT(right(0), 20);
  frame.camera.eye.y() *= -1; // from behind
  frame.light = Eigen::Vector3d(-0.5, 0.6, 1);
  const int through = right(0); // as ink that has soaked through
  EXPECT_GT(through, 60);
  EXPECT_LT(left(0), 20);
  frame.bodies[0].back = {{180, 180, 0}};
  EXPECT_GT(left(1), 100);
  EXPECT_GT(right(1), 100);
  frame.bodies[0].texture.back = green;
  EXPECT_GT(left(1), 100);
  EXPECT_LT(right(1), 20);
  frame.bodies[0].texture.front = nullptr; // the back's alone
  EXPECT_GT(left(1), 100);
  frame.camera.eye.y() *= -1;
  frame.light = view().light;
  EXPECT_LE(largest_difference(picture(frame), picture(view())), 1);
}

TEST_F(TexturedBody, has_holes_where_its_picture_is_transparent_and_so_has_its_shadow) {
  const auto window = [](std::uint8_t alpha) {
    return make_texture(painted(16, 16, [&](int x, int y) {
      const bool hole = x > 3 && x < 12 && y > 3 && y < 12;
      return Colour{170, 170, 170, hole ? alpha : std::uint8_t{255}};
    }));
  };
  Frame frame = with_picture(window(0));
  frame.bodies.push_back(screen(1, 0.3f, red)); // behind it
  const Image hole = picture(frame);
  EXPECT_GT(hole.at(side / 2, side / 2)[0], hole.at(side / 2, side / 2)[1] + 60);
  EXPECT_LT(hole.at(side / 5, side / 2)[0], hole.at(side / 5, side / 2)[1] + 10);
  frame.bodies[0].texture.front = window(140); // opaque enough
  const Image whole = picture(frame);
  EXPECT_LT(whole.at(side / 2, side / 2)[0], whole.at(side / 2, side / 2)[1] + 10);

  // the shadow on a screen behind, and on the floor
  const auto shadow = [&](std::uint8_t alpha, bool on_floor) {
    Frame shaded = with_picture(window(alpha), Wrap::Clamp);
    shaded.camera.eye = {0, 3, 3};
    shaded.camera.target = {0, on_floor ? 1.2 : 0.0, on_floor ? -0.5 : 0.0};
    shaded.camera.fov = 40;
    shaded.light = Eigen::Vector3d(0, -0.6, 0.5);
    if (on_floor) shaded.floor = FrameFloor{-half};
    if (!on_floor) shaded.bodies.push_back(screen(0.7f, 2, grey));
    if (!on_floor) shaded.camera.eye = {2, -3, 0};
    return picture(shaded);
  };
  for (const bool on_floor : {true, false})
    EXPECT_GT(largest_difference(shadow(0, on_floor), shadow(255, on_floor)), 40) << on_floor;
}

TEST_F(TexturedBody, goes_with_transparent_pictures_occlusion_wires_and_motion_blur) {
  const auto texture = make_texture(painted(2, 2, [](int x, int y) {
    return x == y ? Colour{180, 0, 0, 255} : Colour{0, 0, 180, 255};
  }));
  Frame frame = with_picture(texture);
  const auto middle_of_left = [](const Image& image) { return image.at(side / 3, side / 3); };
  frame.transparent = true;
  const Image clear = picture(frame);
  EXPECT_EQ(clear.channels, 4);
  EXPECT_EQ(middle_of_left(clear)[3], 255);
  EXPECT_GT(middle_of_left(clear)[0], 100);
  frame.transparent = false;
  frame.occlusion = true;
  EXPECT_GT(middle_of_left(picture(frame))[0], 100);
  frame.occlusion = false;
  const Image still = picture(frame);
  Frame blurred = view();
  blurred.camera = frame.camera;
  blurred.states = {{frame.bodies, {}, 0}, {frame.bodies, {}, 0}};
  blurred.moments = {{0, 1, 0.5, frame.camera, 1}, {0, 1, 1, frame.camera, 1}};
  blurred.bodies.clear();
  EXPECT_EQ(largest_difference(picture(blurred), still), 0);
  frame.bodies[0].filled = false;
  frame.bodies[0].edges = true;
  for (Corner& corner : frame.bodies[0].corners) corner.line = {2, 2, 2, 0};
  const Image wires = picture(frame);
  int reddest = 0;
  for (int x = 0; x < side / 4; ++x)
    reddest = std::max(reddest, wires.at(x, side / 3)[0] - wires.at(x, side / 3)[1]);
  EXPECT_GT(reddest, 30) << "lines have the colours of the picture";
}

// A black square, so that all of its light is the highlight: against finish.h's formula, in bands of a picture.
TEST_F(TexturedBody, is_as_glossy_as_a_picture_of_its_roughness_says) {
  constexpr std::array<std::uint8_t, 4> rough{0, 45, 128, 255}; // from left to right
  const auto bands = make_number_texture(painted(4, 1, [&](int x, int) {
    return Colour{7, rough[static_cast<std::size_t>(x)], 200, 255};
  }));
  for (const int sharpness : {1, 3, 5, 7}) {
    Frame frame = view();
    frame.light =
        Eigen::Vector3d(-0.2, -1, 0.28); // at some 19 degrees from the camera: the lamp is not reflected
    FrameBody& body = frame.bodies.front();
    for (Corner& corner : body.corners) corner.colour = {0, 0, 0, 255};
    body.finish.gloss = 0.8f;
    body.finish.sharpness = sharpness;
    const Image plain_finish = picture(frame);
    body.texture.roughness = bands;
    body.texture.wrap = Wrap::Clamp;
    for (const Corner& corner : body.corners)
      body.texture_points.push_back({corner.position[0] + 0.5f, corner.position[2] + 0.5f});
    const Image now = picture(frame);
    const double cosine = 1 / std::sqrt(1 + 0.2 * 0.2 + 0.28 * 0.28);
    const double least = std::sqrt(2 / (std::pow(2.0, sharpness) + 2));
    for (std::size_t n = 0; n < rough.size(); ++n) {
      const int x = static_cast<int>(side * (0.5 + share * ((static_cast<double>(n) + 0.5) / 4 - 0.5)));
      const double a = least + (0.8 - least) * rough[n] / 255.0, exponent = 2 / (a * a) - 2;
      const double light = 0.8 * (least * least) / (a * a) * std::pow(cosine, exponent);
      EXPECT_NEAR(middle(now, x, 1), 255 * std::sqrt(light), 2) << sharpness << ", " << n;
    }
    EXPECT_NEAR(middle(now, side / 2 - 40, 1), middle(plain_finish, side / 2 - 40, 1), 1) << "0: as the finish";
  }
}

// What one Renderer drew before is no part of what it draws now.
TEST_F(TexturedBody, leaves_nothing_to_the_next_frame) {
  const auto texture = make_texture(painted(2, 2, [](int x, int) {
    return Colour{static_cast<std::uint8_t>(170 * x), 0, 90, 255};
  }));
  const auto holed = make_texture(painted(2, 2, [](int x, int) {
    return Colour{90, 90, 90, static_cast<std::uint8_t>(255 * x)};
  }));
  const std::vector<Frame> frames{view(), with_picture(texture), with_picture(holed, Wrap::Mirror, 3), view(),
                                  with_picture(texture, Wrap::Repeat, 2)};
  Renderer renderer(side, side, 4);
  for (const Frame& frame : frames) {
    renderer.draw(frame);
    EXPECT_EQ(renderer.read(), picture(frame));
  }
}

} // namespace
} // namespace rend::textured_body_test
