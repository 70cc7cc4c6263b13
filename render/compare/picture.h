// A picture as it is compared: planes of levels, whatever the file was.
//
// A level is a float from 0 to 255: that of 8 bits as it stands, that of 16 bits divided by 257. Where a
// picture is transparent its colours are multiplied by alpha: what cannot be seen does not count, and two
// pixels are equal if and only if they look the same over every background. A picture without alpha is opaque:
// it equals one whose alpha is 255 everywhere.
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

Picture picture_of(const DeepImage& image);

// As it looks on white paper, without alpha. What the eye sees (SSIM, FLIP) is compared so.
Picture over_white(Picture picture);

// Which pixels count.
struct Mask {
  std::vector<std::uint8_t> counts; // height x width: 1 counts, 0 does not; empty: all count

  bool operator[](std::size_t pixel) const { return counts.empty() || counts[pixel] != 0; }
};

// White counts, black does not: a pixel whose red, over black, is below 128 is left out.
Mask mask_of(const Picture& picture);

// Makes `b` equal to `a` wherever the mask does not count, so that what is left out cannot reach the pixels
// beside it through the filters of SSIM and FLIP. All of one size; both with alpha or neither (CHECK).
void leave_out(const Mask& mask, const Picture& a, Picture& b);

// Gives an opaque picture its alpha, where another has one.
void make_alpha(Picture& picture);

} // namespace rend
