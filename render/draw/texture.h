// A picture that is drawn on a body, or whose numbers are used there, with its mip levels.
//
// Levels are made here and not by OpenGL, in light: a minified picture has the mean light of the whole one, on
// every machine the same. Each level is half as large as the one before, rounded down. Its texels are means
// over boxes: of 2 x 2 texels, of 3 where a side is odd, the outer ones weighted by what of them lies in the
// box, so that every level has exactly the same mean:
//
//   n = 2m + 1, texel i of m:  ((m - i) x[2i] + m x[2i+1] + (i + 1) x[2i+2]) / n
//
// Light is that of sRGB (light_average.h), and levels are sRGB again. Colours are weighted by alpha, so that
// what is transparent has none. Numbers that are no colours (how rough a surface is) have one
// channel, and their means are plain ones.
//
// All levels are made in one pass over the rows of the picture, whose memory the first level takes over: a
// picture of 4096 x 4096 pixels and its levels take 67 MB, also while they are made, where whole levels of
// light beside them took 177.
#pragma once

#include "render/files/image.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace rend {

constexpr int largest_texture = 4096; // [pixels], of each side

struct TextureLevel {
  int width = 0, height = 0;        // [texels]
  int channels = 4;                 // 3 where the texture is opaque, 1 of numbers
  std::vector<std::uint8_t> texels; // sRGB, and alpha; height x width x channels, row 0 at the bottom

  std::size_t stride() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels); }
};

struct Texture {
  std::vector<TextureLevel> levels; // down to 1 x 1
  bool cut_out = false;             // some of it is transparent: below an alpha of one half there is a hole

  double aspect() const { return static_cast<double>(levels.front().width) / levels.front().height; }
};

// Whether it has a pixel that is not opaque.
bool is_transparent(const Image& image);

// CHECK: at most largest_texture pixels wide and high.
std::shared_ptr<const Texture> make_texture(Image image);

// Of the numbers in the green channel, where glTF has the roughness; in grey pictures all channels are alike.
// CHECK as above.
std::shared_ptr<const Texture> make_number_texture(const Image& image);

} // namespace rend
