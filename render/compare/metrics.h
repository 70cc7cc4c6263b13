// All metrics between two pictures; each is computed in a file of its own beside this one.
#pragma once

#include "render/compare/difference.h"
#include "render/compare/window.h"

namespace rend {

struct FlipFigures {
  double mean = 0, max = 0;                   // over unmasked pixels
  double quartile = 0, median = 0, upper = 0; // weighted percentiles 25, 50, 75
};

struct Metrics {
  Difference difference;
  OverThreshold over;
  double ssim = 1;
  FlipFigures flip;
  Pixel worst;              // centre of the 16 x 16 window in which FLIP is largest: where to look
  std::size_t smoothed = 0; // pixels left out because an edge is smoothed differently there (antialiasing.h)
  Levels flip_map;          // height x width; empty where the pictures are equal
};

struct MeasureOptions {
  double threshold = 0; // [levels] a pixel with a larger difference counts as over the threshold
  int window_side = 16; // [pixels]
  int threads = 1;
  bool leave_out_smoothed = false; // antialiasing.h
};

// Two pictures of one size (CHECK). Masked pixels enter no metric. The same on any number of threads.
Metrics measure(Picture a, Picture b, const PixelMask& mask, const MeasureOptions& options);

} // namespace rend
