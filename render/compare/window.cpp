#include "render/compare/window.h"

#include "sim/base/check.h"

#include <algorithm>

namespace rend {

namespace {

struct Densest {
  Pixel corner; // upper left; the first of equals in row order
  double sum = 0;
};

// The window of across x down pixels with the largest sum of value(x, y) ≥ 0.
template <class Value> Densest densest(int width, int height, int across, int down, const Value& value) {
  Densest out;
  std::vector<double> columns(static_cast<std::size_t>(width)); // column sums over the rows of the window
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) columns[x] += value(x, y) - (y >= down ? value(x, y - down) : 0);
    if (y + 1 < down) continue;
    double sum = 0;
    for (int x = 0; x < width; ++x) {
      sum += columns[x] - (x >= across ? columns[x - across] : 0);
      if (x + 1 < across || sum <= out.sum) continue;
      out = {{x + 1 - across, y + 1 - down}, sum};
    }
  }
  return out;
}

} // namespace

OverThreshold over_threshold(const Difference& difference, int width, int height, double threshold, int side) {
  CHECK(side >= 1 && difference.largest.size() == static_cast<std::size_t>(width) * height);
  OverThreshold out;
  out.width = std::min(side, width);
  out.height = std::min(side, height);
  out.pixels = static_cast<std::size_t>(std::count_if(difference.largest.begin(), difference.largest.end(),
                                                      [&](float level) { return level > threshold; }));
  out.share =
      static_cast<double>(out.pixels) / static_cast<double>(std::max<std::size_t>(difference.counted, 1));
  const Densest window =
      densest(width, height, out.width, out.height, [&](int x, int y) { // sums of 0 and 1 are exact
        return difference.largest[static_cast<std::size_t>(y) * width + x] > threshold ? 1. : 0.;
      });
  out.corner = window.corner;
  out.dense = window.sum / (static_cast<double>(out.width) * out.height);
  return out;
}

Pixel brightest_window(const Levels& map, int width, int height, int side) {
  CHECK(side >= 1 && map.size() == static_cast<std::size_t>(width) * height);
  return densest(
             width, height, std::min(side, width), std::min(side, height),
             [&](int x, int y) { return static_cast<double>(map[static_cast<std::size_t>(y) * width + x]); })
      .corner;
}

} // namespace rend
