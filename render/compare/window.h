// What is over a threshold: how much of the picture, and where it lies densest.
//
// A share of the whole says little of a lost triangle in a large picture. The densest window of N × N pixels
// tells it from the same number of pixels strewn about, and is where to look.
#pragma once

#include "render/compare/difference.h"

namespace rend {

struct OverThreshold {
  std::size_t pixels = 0;    // whose largest difference is above the threshold
  double share = 0;          // of the pixels that count
  Pixel corner;              // the upper left one of the densest window, the first of equals by rows
  int width = 0, height = 0; // [pixels] of that window: N, or the picture's side where that is less
  double dense = 0;          // the share of that window's pixels which are over the threshold
};

// `threshold` in levels; `side`: N, at least 1 (CHECK).
OverThreshold over_threshold(const Difference& difference, int width, int height, double threshold, int side);

// The upper left corner of the window of side x side pixels in which a map's sum is largest: where an eye would
// look. The window is as narrow or low as the picture where that is smaller.
Pixel brightest_window(const Levels& map, int width, int height, int side);

} // namespace rend
