#include "render/draw/texture.h"

#include "render/draw/light_average.h"
#include "sim/base/check.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rend {
namespace {

constexpr double full_light = 65535;
using Light = std::array<double, 4>; // red, green, blue times alpha, and alpha: 0 to 65535

std::uint16_t rounded(double x) {
  return static_cast<std::uint16_t>(x + 0.5);
}

// One level while others are made of it.
struct LightLevel {
  int width, height;
  std::vector<std::uint16_t> values; // height x width x 4, row 0 at the bottom: Light, rounded

  Light at(int x, int y) const {
    const std::uint16_t* of = &values[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                           static_cast<std::size_t>(x))];
    return {static_cast<double>(of[0]), static_cast<double>(of[1]), static_cast<double>(of[2]),
            static_cast<double>(of[3])};
  }
};

// The same of a picture itself.
struct LightImage {
  const Image& image;

  Light at(int x, int y) const {
    const std::uint8_t* pixel = image.at(x, image.height - 1 - y);
    const int alpha = image.channels == 4 ? pixel[3] : 255;
    const auto channel = [&](int c) { return light_of_level(pixel[c]) * (alpha / 255.0); };
    return {channel(0), channel(1), channel(2), 257.0 * alpha};
  }
};

// What a texel of the next level takes of a row or column of n texels.
struct Taps {
  int first = 0, count = 1;
  std::array<double, 3> share{1, 0, 0};
};

Taps taps_of(int i, int n) {
  if (n == 1) return {};
  if (n % 2 == 0) return {2 * i, 2, {0.5, 0.5, 0}};
  const int m = n / 2;
  const double whole = n;
  return {2 * i, 3, {(m - i) / whole, m / whole, (i + 1) / whole}};
}

template <class From> LightLevel halved(const From& from, int width, int height) {
  LightLevel to{std::max(width / 2, 1), std::max(height / 2, 1), {}};
  to.values.reserve(std::size_t{4} * static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height));
  for (int y = 0; y < to.height; ++y) {
    const Taps rows = taps_of(y, height);
    for (int x = 0; x < to.width; ++x) {
      const Taps columns = taps_of(x, width);
      Light sum{};
      for (int j = 0; j < rows.count; ++j)
        for (int i = 0; i < columns.count; ++i) {
          const Light one = from.at(columns.first + i, rows.first + j);
          const double share =
              rows.share[static_cast<std::size_t>(j)] * columns.share[static_cast<std::size_t>(i)];
          for (std::size_t c = 0; c < 4; ++c) sum[c] += share * one[c];
        }
      for (const double value : sum) to.values.push_back(rounded(value));
    }
  }
  return to;
}

template <class From> TextureLevel texels_of(const From& from, int width, int height) {
  TextureLevel level{width, height, {}};
  level.texels.reserve(std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Light light = from.at(x, y);
      const double alpha = light[3] / full_light;
      for (std::size_t c = 0; c < 3; ++c) {
        const double own = alpha > 0 ? std::min(light[c] / alpha, full_light) : 0;
        level.texels.push_back(level_of_light(rounded(own)));
      }
      level.texels.push_back(static_cast<std::uint8_t>(255 * alpha + 0.5));
    }
  return level;
}

} // namespace

bool is_transparent(const Image& image) {
  if (image.channels < 4) return false;
  for (std::size_t n = 3; n < image.pixels.size(); n += 4)
    if (image.pixels[n] != 255) return true;
  return false;
}

std::shared_ptr<const Texture> make_texture(const Image& image) {
  CHECK(image.width >= 1 && image.height >= 1 && std::max(image.width, image.height) <= largest_texture);
  auto texture = std::make_shared<Texture>();
  texture->cut_out = is_transparent(image);
  const LightImage whole{image};
  texture->levels.push_back(texels_of(whole, image.width, image.height));
  if (std::max(image.width, image.height) == 1) return texture;
  LightLevel level = halved(whole, image.width, image.height);
  while (true) {
    texture->levels.push_back(texels_of(level, level.width, level.height));
    if (std::max(level.width, level.height) == 1) return texture;
    level = halved(level, level.width, level.height);
  }
}

} // namespace rend
