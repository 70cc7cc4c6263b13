#include "render/draw/texture.h"

#include "render/draw/light_average.h"
#include "sim/base/check.h"

#include <algorithm>
#include <array>
#include <utility>

namespace rend {
namespace {

constexpr double full_light = 65535;
using Light = std::array<double, 4>; // red, green, blue times alpha, and alpha: 0 to 65535
using LightRow = std::vector<Light>;

std::uint16_t rounded(double x) {
  return static_cast<std::uint16_t>(x + 0.5);
}

// What a texel of the next level takes of a row or column of n texels.
struct Taps {
  int first = 0, count = 1;
  std::array<double, 3> share{1, 0, 0};
  int end() const { return first + count; }
};

Taps taps_of(int i, int n) {
  if (n == 1) return {};
  if (n % 2 == 0) return {2 * i, 2, {0.5, 0.5, 0}};
  const int m = n / 2;
  const double whole = n;
  return {2 * i, 3, {(m - i) / whole, m / whole, (i + 1) / whole}};
}

int halved(int n) {
  return std::max(n / 2, 1);
}

// The rows of one level, from those of the level before as they come.
class RowHalver {
public:
  RowHalver(int width, int height) : width_(width), height_(height) {}

  // The next row, if that was the last one that it takes; else null. Valid until the next call.
  const LightRow* take(const LightRow& row) {
    last_[static_cast<std::size_t>(taken_++ % 3)] = row;
    if (made_ == halved(height_)) return nullptr;
    const Taps rows = taps_of(made_, height_);
    if (taken_ < rows.end()) return nullptr;
    ++made_;
    row_.clear();
    for (int x = 0; x < halved(width_); ++x) row_.push_back(texel(rows, taps_of(x, width_)));
    return &row_;
  }

private:
  Light texel(const Taps& rows, const Taps& columns) const {
    Light sum{};
    for (int j = 0; j < rows.count; ++j)
      for (int i = 0; i < columns.count; ++i) {
        const Light& one =
            last_[static_cast<std::size_t>((rows.first + j) % 3)][static_cast<std::size_t>(columns.first + i)];
        const double share =
            rows.share[static_cast<std::size_t>(j)] * columns.share[static_cast<std::size_t>(i)];
        for (std::size_t c = 0; c < 4; ++c) sum[c] += share * one[c];
      }
    for (double& value : sum) value = rounded(value);
    return sum;
  }

  int width_, height_; // of the level before [texels]
  int taken_ = 0, made_ = 0;
  std::array<LightRow, 3> last_; // row n of the level before is in n % 3
  LightRow row_;
};

void append(TextureLevel& level, const LightRow& row) {
  for (const Light& light : row) {
    if (level.channels == 1) {
      level.texels.push_back(static_cast<std::uint8_t>(light[0] / 257 + 0.5));
      continue;
    }
    const double alpha = light[3] / full_light;
    for (std::size_t c = 0; c < 3; ++c) {
      const double own = alpha > 0 ? std::min(light[c] / alpha, full_light) : 0;
      level.texels.push_back(level_of_light(rounded(own)));
    }
    if (level.channels == 4) level.texels.push_back(static_cast<std::uint8_t>(255 * alpha + 0.5));
  }
}

void read_row(const TextureLevel& level, int y, LightRow& row) {
  const std::uint8_t* texel = level.texels.data() + level.stride() * static_cast<std::size_t>(y);
  for (Light& light : row) {
    if (level.channels == 1) {
      light = {257.0 * *texel++, 0, 0, full_light};
      continue;
    }
    const int alpha = level.channels == 4 ? texel[3] : 255;
    for (std::size_t c = 0; c < 3; ++c) light[c] = light_of_level(texel[c]) * (alpha / 255.0);
    light[3] = 257.0 * alpha;
    texel += level.channels;
  }
}

void check_size(const Image& image) {
  CHECK(image.width >= 1 && image.height >= 1 && std::max(image.width, image.height) <= largest_texture);
}

void remove_alpha(Image& image) {
  std::uint8_t* to = image.pixels.data();
  for (std::size_t at = 0; at < image.pixels.size(); at += 4)
    for (std::size_t c = 0; c < 3; ++c) *to++ = image.pixels[at + c];
  image.pixels.resize(image.pixels.size() / 4 * 3);
  image.channels = 3;
}

void remove_colour_of_what_is_transparent(Image& image) {
  for (std::size_t at = 0; at < image.pixels.size(); at += 4)
    if (image.pixels[at + 3] == 0) std::fill_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(at), 3, 0);
}

// In the memory of the picture.
TextureLevel first_level(Image image, bool cut_out) {
  if (image.channels == 4 && !cut_out) remove_alpha(image);
  if (cut_out) remove_colour_of_what_is_transparent(image);
  for (int low = 0, high = image.height - 1; low < high; ++low, --high)
    std::swap_ranges(image.row(low), image.row(low) + image.stride(), image.row(high));
  return {image.width, image.height, image.channels, std::move(image.pixels)};
}

std::vector<TextureLevel> levels_from(TextureLevel first) {
  std::vector<TextureLevel> levels;
  levels.push_back(std::move(first)); // in braces it would be copied
  std::vector<RowHalver> halvers;     // [n] makes level n + 1
  while (levels.back().width > 1 || levels.back().height > 1) {
    const TextureLevel& before = levels.back();
    halvers.emplace_back(before.width, before.height);
    TextureLevel level{halved(before.width), halved(before.height), before.channels, {}};
    level.texels.reserve(level.stride() * static_cast<std::size_t>(level.height));
    levels.push_back(std::move(level));
  }
  LightRow whole(static_cast<std::size_t>(levels.front().width));
  for (int y = 0; y < levels.front().height; ++y) {
    read_row(levels.front(), y, whole);
    const LightRow* row = &whole;
    for (std::size_t n = 0; n < halvers.size() && row != nullptr; ++n) {
      row = halvers[n].take(*row);
      if (row != nullptr) append(levels[n + 1], *row);
    }
  }
  return levels;
}

} // namespace

bool is_transparent(const Image& image) {
  if (image.channels < 4) return false;
  for (std::size_t n = 3; n < image.pixels.size(); n += 4)
    if (image.pixels[n] != 255) return true;
  return false;
}

std::shared_ptr<const Texture> make_number_texture(const Image& image) {
  check_size(image);
  TextureLevel first{image.width, image.height, 1, {}};
  first.texels.reserve(first.stride() * static_cast<std::size_t>(first.height));
  for (int y = image.height - 1; y >= 0; --y)
    for (int x = 0; x < image.width; ++x) first.texels.push_back(image.at(x, y)[1]);
  auto texture = std::make_shared<Texture>();
  texture->levels = levels_from(std::move(first));
  return texture;
}

std::shared_ptr<const Texture> make_texture(Image image) {
  check_size(image);
  auto texture = std::make_shared<Texture>();
  texture->cut_out = is_transparent(image);
  texture->levels = levels_from(first_level(std::move(image), texture->cut_out));
  return texture;
}

} // namespace rend
