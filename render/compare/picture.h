// A picture as it is compared: planes of levels, whatever the format of the file.
//
// A level is a float from 0 to 255: an 8-bit sample unchanged, a 16-bit sample divided by 257. Colours are
// premultiplied by alpha: invisible colours do not count, and two pixels are equal if and only if they look the
// same over every background. A picture without alpha is opaque: it equals one whose alpha is 255 everywhere.
#pragma once

#include "render/files/png_reader.h"

#include <array>
#include <cstdint>
#include <vector>

namespace rend {

using Levels = std::vector<float>; // height x width, row 0 is the top

struct Picture {
  int width = 0, height = 0; // [pixels]
  bool alpha = false;
  std::array<Levels, 4> planes; // red, green, blue, alpha (empty where `alpha` is false), 0 to 255

  std::size_t pixels() const { return static_cast<std::size_t>(width) * height; }
};

Picture picture_of(const HighDepthImage& image);

// The picture composited over white, without alpha. Perceptual metrics (SSIM, FLIP) compare this.
Picture over_white(Picture picture);

// The pixels that are compared.
struct PixelMask {
  std::vector<std::uint8_t> counts; // height x width: 1 is compared, 0 is not; empty: all are compared

  bool operator[](std::size_t pixel) const { return counts.empty() || counts[pixel] != 0; }
};

// White is compared, black is not: a pixel whose red, over black, is below 128 is masked out.
PixelMask mask_of(const Picture& picture);

// Sets masked pixels of `b` to those of `a`, so that they cannot influence their neighbours through the filters
// of SSIM and FLIP. All of one size; both with alpha or neither (CHECK).
void mask_out(const PixelMask& mask, const Picture& a, Picture& b);

// Adds an alpha plane to an opaque picture.
void add_alpha(Picture& picture);

} // namespace rend
