// Pixels whose difference is over a threshold: their share of the picture, and the window where they are
// densest.
//
// A lost triangle hardly changes the share in a large picture. The densest window of N × N pixels distinguishes
// it from the same number of scattered pixels, and shows where to look.
#pragma once

#include "render/compare/difference.h"

namespace rend {

struct OverThreshold {
  std::size_t pixels = 0;    // whose largest difference is above the threshold
  double share = 0;          // of the unmasked pixels
  Pixel corner;              // upper left, of the densest window; the first of equals in row order
  int width = 0, height = 0; // [pixels] of that window: N, or the picture's side where that is less
  double dense = 0;          // the share of that window's pixels that are over the threshold
};

// `threshold` in levels; `side`: N, at least 1 (CHECK).
OverThreshold over_threshold(const Difference& difference, int width, int height, double threshold, int side);

// The upper left corner of the window of side x side pixels with the largest sum of a map. A window is cut to
// the size of a smaller picture.
Pixel brightest_window(const Levels& map, int width, int height, int side);

} // namespace rend
