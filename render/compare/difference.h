// How far two pictures are apart, pixel by pixel.
//
//   d(p, c) = |a(p, c) − b(p, c)|                 [levels], of every pixel p that counts and every channel c
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
  std::size_t counted = 0;            // pixels that count
  std::size_t differing = 0;          // those of them that differ at all
  Pixel worst;                        // the first pixel whose difference is `max`
  Levels largest; // [levels] the largest d of each pixel over its channels; 0 where it does not count
};

// Pictures of one size, both with alpha or neither (CHECK).
Difference difference_of(const Picture& a, const Picture& b, const Mask& mask, int threads);

} // namespace rend
