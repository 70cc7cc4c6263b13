// Difference metrics of two pictures, pixel by pixel: maximum, mean, RMSE, PSNR.
//
//   d(p, c) = |a(p, c) − b(p, c)|                 [levels], of every unmasked pixel p and every channel c
//   max = max d     mean = Σ d / N     RMSE = √(Σ d² / N)
//   PSNR = 20 log10(255 / RMSE) [dB], infinite where equal
//
// N: pixels times channels (3, or 4 where one has alpha). Sums run along each row and then over the rows, so
// that they are the same on any number of threads.
#pragma once

#include "render/compare/picture.h"

namespace rend {

struct Pixel {
  int x = 0, y = 0; // from the upper left corner
};

struct Difference {
  double max = 0, mean = 0, rmse = 0; // [levels]
  double psnr = 0;                    // [dB]
  std::size_t counted = 0;            // unmasked pixels
  std::size_t differing = 0;          // unmasked pixels that differ at all
  Pixel worst;                        // the first pixel whose difference is `max`
  Levels largest; // [levels] per pixel, the largest d over its channels; 0 where it is masked out
};

// Pictures of one size, both with alpha or neither (CHECK).
Difference difference_of(const Picture& a, const Picture& b, const PixelMask& mask, int threads);

} // namespace rend
