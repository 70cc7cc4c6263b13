#include "render/compare/window.h"

#include "sim/base/check.h"

#include <algorithm>

namespace rend {

OverThreshold over_threshold(const Difference& difference, int width, int height, double threshold, int side) {
  CHECK(side >= 1 && difference.largest.size() == static_cast<std::size_t>(width) * height);
  OverThreshold out;
  out.width = std::min(side, width);
  out.height = std::min(side, height);
  const auto over = [&](int x, int y) -> int {
    return difference.largest[static_cast<std::size_t>(y) * width + x] > threshold ? 1 : 0;
  };
  std::vector<int> columns(
      static_cast<std::size_t>(width)); // pixels over it in the rows of the window, per column
  long most = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int now = over(x, y);
      out.pixels += static_cast<std::size_t>(now);
      columns[x] += now - (y >= out.height ? over(x, y - out.height) : 0);
    }
    if (y + 1 < out.height) continue;
    long sum = 0;
    for (int x = 0; x < width; ++x) {
      sum += columns[x] - (x >= out.width ? columns[x - out.width] : 0);
      if (x + 1 < out.width || sum <= most) continue;
      most = sum;
      out.corner = {x + 1 - out.width, y + 1 - out.height};
    }
  }
  out.share =
      static_cast<double>(out.pixels) / static_cast<double>(std::max<std::size_t>(difference.counted, 1));
  out.dense = static_cast<double>(most) / (static_cast<double>(out.width) * out.height);
  return out;
}

} // namespace rend
