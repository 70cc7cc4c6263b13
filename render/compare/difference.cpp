#include "render/compare/difference.h"

#include "sim/base/check.h"
#include "sim/base/threads.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {
namespace {

struct RowDifference {
  double sum = 0, squares = 0; // [levels], [levels²]
  float max = 0;               // [levels]
  int at = 0;                  // x of the first `max`
  std::size_t counted = 0, differing = 0;
};

RowDifference row_of(const Picture& a, const Picture& b, const PixelMask& mask, int y, float* largest) {
  RowDifference row;
  const std::size_t start = static_cast<std::size_t>(y) * a.width, channels = a.alpha ? 4 : 3;
  for (int x = 0; x < a.width; ++x) {
    const std::size_t n = start + x;
    if (!mask[n]) continue;
    float most = 0;
    for (std::size_t c = 0; c < channels; ++c) {
      const float d = std::abs(a.planes[c][n] - b.planes[c][n]);
      row.sum += d;
      row.squares += static_cast<double>(d) * d;
      most = std::max(most, d);
    }
    largest[n] = most;
    ++row.counted;
    if (most > 0) ++row.differing;
    if (most > row.max) {
      row.max = most;
      row.at = x;
    }
  }
  return row;
}

} // namespace

Difference difference_of(const Picture& a, const Picture& b, const PixelMask& mask, int threads) {
  CHECK(a.width == b.width && a.height == b.height && a.alpha == b.alpha);
  Difference out;
  out.largest.resize(a.pixels());
  std::vector<RowDifference> rows(static_cast<std::size_t>(a.height));
  parallel_ranges(threads, rows.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y)
      rows[y] = row_of(a, b, mask, static_cast<int>(y), out.largest.data());
  });
  double squares = 0;
  for (std::size_t y = 0; y < rows.size(); ++y) {
    const RowDifference& row = rows[y];
    out.mean += row.sum;
    squares += row.squares;
    out.counted += row.counted;
    out.differing += row.differing;
    if (row.max > out.max) {
      out.max = row.max;
      out.worst = {row.at, static_cast<int>(y)};
    }
  }
  const double all = static_cast<double>(std::max<std::size_t>(out.counted, 1)) * (a.alpha ? 4 : 3);
  out.mean /= all;
  out.rmse = std::sqrt(squares / all);
  out.psnr = out.rmse > 0 ? 20 * std::log10(255 / out.rmse) : std::numeric_limits<double>::infinity();
  return out;
}

} // namespace rend
