// Mip levels, against the formulas of sRGB (IEC 61966-2-1) written out here.
#include "render/draw/texture.h"

#include "tests/render/peak_memory.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace rend::texture_test {
namespace {

double light_of(double number) {
  return number <= 0.04045 ? number / 12.92 : std::pow((number + 0.055) / 1.055, 2.4);
}
double number_of(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

int shown(const TextureLevel& level, int x, int y, std::size_t c) {
  return level.texels[static_cast<std::size_t>(level.channels * (y * level.width + x)) + c];
}

Image noise(int width, int height, int channels) {
  Image image(width, height, channels);
  std::mt19937 random(static_cast<unsigned>(width * 1000 + height));
  for (std::uint8_t& byte : image.pixels) byte = static_cast<std::uint8_t>(random() >> 24);
  return image;
}

TEST(Texture, shows_the_numbers_of_its_pixels_with_the_lowest_row_first) {
  Image image(256, 2);
  for (int x = 0; x < 256; ++x)
    for (int c = 0; c < 3; ++c) image.row(1)[3 * x + c] = static_cast<std::uint8_t>(x);
  const auto texture = make_texture(image);
  EXPECT_FALSE(texture->cut_out);
  for (int x = 0; x < 256; ++x) {
    EXPECT_EQ(shown(texture->levels[0], x, 0, 1), x);
    EXPECT_EQ(shown(texture->levels[0], x, 1, 1), 0);
  }
}

TEST(Texture, is_halved_down_to_one_texel) {
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 2}, {5, 3}, {7, 64}, {1, 9}, {33, 32}}) {
    const auto texture = make_texture(noise(width, height, 3));
    int w = width, h = height;
    for (const TextureLevel& level : texture->levels) {
      EXPECT_EQ(level.width, w);
      EXPECT_EQ(level.height, h);
      EXPECT_EQ(level.texels.size(), static_cast<std::size_t>(3 * w * h));
      w = std::max(w / 2, 1);
      h = std::max(h / 2, 1);
    }
    EXPECT_EQ(texture->levels.back().texels.size(), 3U);
  }
}

TEST(Texture, has_the_same_mean_light_on_every_level_even_of_odd_sizes) {
  for (const auto& [width, height] : {std::pair{64, 64}, {5, 3}, {7, 61}, {1, 9}, {101, 37}, {3, 3}}) {
    const Image image = noise(width, height, 3);
    const auto texture = make_texture(image);
    for (std::size_t c = 0; c < 3; ++c) {
      double mean = 0;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) mean += light_of(image.at(x, y)[c] / 255.0) / (width * height);
      for (const TextureLevel& level : texture->levels) {
        double of_level = 0;
        for (int y = 0; y < level.height; ++y)
          for (int x = 0; x < level.width; ++x)
            of_level += light_of(shown(level, x, y, c) / 255.0) / (level.width * level.height);
        EXPECT_NEAR(255 * number_of(of_level), 255 * number_of(mean), 0.8)
            << level.width << " x " << level.height;
      }
    }
  }
}

// Sources of a texel by the shares of its box: those of the middle column of three are as large as of the
// others.
TEST(Texture, weighs_an_odd_row_by_what_lies_in_a_box) {
  Image image(5, 1);
  for (int x = 0; x < 5; ++x)
    for (int c = 0; c < 3; ++c) image.row(0)[3 * x + c] = x == 2 ? 255 : 0;
  const TextureLevel level = make_texture(image)->levels[1];
  ASSERT_EQ(level.width, 2); // boxes of 2.5 texels: the middle one is halved
  for (int x = 0; x < 2; ++x) EXPECT_NEAR(shown(level, x, 0, 0), 255 * number_of(0.2), 0.8);
}

TEST(Texture, gives_no_colour_to_what_is_transparent) {
  Image image(2, 1, 4);
  image.pixels = {0, 200, 0, 255, 255, 0, 0, 0};
  const auto texture = make_texture(image);
  EXPECT_TRUE(texture->cut_out);
  const TextureLevel& mean = texture->levels.at(1);
  EXPECT_EQ(mean.texels[0], 0) << "red";
  EXPECT_NEAR(shown(mean, 0, 0, 1), 200, 1.5);
  EXPECT_NEAR(mean.texels[3], 127.5, 0.6);
  Image opaque(2, 1, 4);
  opaque.pixels = {0, 200, 0, 255, 255, 0, 0, 255};
  EXPECT_FALSE(make_texture(opaque)->cut_out);
  EXPECT_EQ(make_texture(opaque)->levels[0].texels, (std::vector<std::uint8_t>{0, 200, 0, 255, 0, 0}));
}

// In doubles, without rounding between levels: each level by itself from the whole picture, since shares of
// halves of halves are shares of quarters where sizes are powers of two.
TEST(Texture, of_numbers_has_their_plain_mean_on_every_level) {
  const Image image = noise(37, 20, 3);
  const auto texture = make_number_texture(image);
  EXPECT_FALSE(texture->cut_out);
  double mean = 0;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 37; ++x) mean += image.at(x, y)[1] / (37.0 * 20);
  EXPECT_EQ(shown(texture->levels[0], 5, 0, 0), image.at(5, 19)[1]) << "green, with the lowest row first";
  for (const TextureLevel& level : texture->levels) {
    ASSERT_EQ(level.channels, 1);
    double of_level = 0;
    for (const std::uint8_t number : level.texels) of_level += number;
    EXPECT_NEAR(of_level / static_cast<double>(level.texels.size()), mean, 0.6) << level.width;
  }
}

TEST(Texture, is_the_mean_over_squares_of_the_whole_picture_weighted_by_alpha) {
  const Image image = noise(32, 16, 4);
  const auto texture = make_texture(image);
  for (std::size_t number = 0; number < texture->levels.size() - 1; ++number) { // the last one is 2 x 1, halved
    const TextureLevel& level = texture->levels[number];
    const int side = 1 << number;
    ASSERT_EQ(level.channels, 4);
    for (int y = 0; y < level.height; ++y)
      for (int x = 0; x < level.width; ++x) {
        double alpha = 0, light[3] = {};
        for (int j = 0; j < side; ++j)
          for (int i = 0; i < side; ++i) {
            const std::uint8_t* pixel = image.at(side * x + i, 15 - (side * y + j));
            alpha += pixel[3] / 255.0;
            for (int c = 0; c < 3; ++c) light[c] += light_of(pixel[c] / 255.0) * pixel[3] / 255.0;
          }
        EXPECT_NEAR(shown(level, x, y, 3), 255 * alpha / (side * side), 0.6);
        for (std::size_t c = 0; c < 3 && alpha > 0.2; ++c)
          EXPECT_NEAR(shown(level, x, y, c), 255 * number_of(light[c] / alpha), 0.7);
      }
  }
}

TEST(Texture, of_the_largest_size_takes_a_third_more_than_its_picture_while_it_is_made) {
  const std::int64_t peak = test::peak_of([] {
    Image image(largest_texture, largest_texture);
    std::fill(image.pixels.begin(), image.pixels.end(), std::uint8_t{90});
    if (make_texture(std::move(image))->levels.back().texels[1] != 90) throw 0;
  });
  EXPECT_GT(peak, 50 * test::megabyte); // that of the picture
  EXPECT_LT(peak, 72 * test::megabyte);
}

} // namespace
} // namespace rend::texture_test
