#include "render/compare/ssim.h"

#include "sim/base/check.h"
#include "sim/base/stop_request.h"
#include "sim/base/threads.h"

#include <algorithm>

namespace rend {
namespace {

constexpr int window_side = 7;
constexpr double c1 = (0.01 * 255) * (0.01 * 255), c2 = (0.03 * 255) * (0.03 * 255);

// Column sums over the height of a window, one array per quantity, one number per column of the picture.
struct Sums {
  std::vector<double> a, b, aa, bb, ab;
  explicit Sums(std::size_t width) : a(width), b(width), aa(width), bb(width), ab(width) {}
};

void add_row(const float* a, const float* b, Sums& sums) {
  for (std::size_t x = 0; x < sums.a.size(); ++x) {
    const double p = a[x], q = b[x];
    sums.a[x] += p;
    sums.b[x] += q;
    sums.aa[x] += p * p;
    sums.bb[x] += q * q;
    sums.ab[x] += p * q;
  }
}

// Replaces every entry by the sum of itself and the across − 1 entries after it; the last ones are meaningless
// then.
void add_across(std::vector<double>& column, int across, std::vector<double>& scratch) {
  const std::size_t count = column.size() - static_cast<std::size_t>(across) + 1;
  std::copy_n(column.begin(), count, scratch.begin());
  for (int k = 1; k < across; ++k)
    for (std::size_t x = 0; x < count; ++x) scratch[x] += column[x + static_cast<std::size_t>(k)];
  column.swap(scratch);
}

struct Total {
  double sum = 0;
  std::size_t count = 0;
};

struct Window {
  int across, down;
  double ssim(const Sums& s, std::size_t x) const {
    const double n = static_cast<double>(across) * down, norm = n > 1 ? n / (n - 1) : 1;
    const double ma = s.a[x] / n, mb = s.b[x] / n;
    const double va = norm * (s.aa[x] / n - ma * ma), vb = norm * (s.bb[x] / n - mb * mb),
                 vab = norm * (s.ab[x] / n - ma * mb);
    return (2 * ma * mb + c1) * (2 * vab + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
  }
};

// The windows whose top row is y.
Total total_of(const Levels& a, const Levels& b, const PixelMask& mask, int width, int y,
               const Window& window) {
  const auto row = static_cast<std::size_t>(width);
  Sums sums(row);
  std::vector<double> scratch(row);
  for (int k = 0; k < window.down; ++k) {
    const std::size_t start = static_cast<std::size_t>(y + k) * row;
    add_row(a.data() + start, b.data() + start, sums);
  }
  for (auto* each : {&sums.a, &sums.b, &sums.aa, &sums.bb, &sums.ab}) add_across(*each, window.across, scratch);
  Total total;
  const std::size_t middle = static_cast<std::size_t>(y + window.down / 2) * row + window.across / 2;
  for (std::size_t x = 0; x + window.across <= row; ++x) {
    if (!mask[middle + x]) continue;
    total.sum += window.ssim(sums, x);
    ++total.count;
  }
  return total;
}

} // namespace

double ssim_of(const Picture& a, const Picture& b, const PixelMask& mask, int threads) {
  CHECK(a.width == b.width && a.height == b.height && !a.alpha && !b.alpha);
  const Window window{std::min(window_side, a.width), std::min(window_side, a.height)};
  std::vector<Total> rows(static_cast<std::size_t>(a.height - window.down + 1));
  parallel_ranges(threads, rows.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      throw_if_stop_is_due();
      for (std::size_t c = 0; c < 3; ++c) {
        const Total one = total_of(a.planes[c], b.planes[c], mask, a.width, static_cast<int>(y), window);
        rows[y].sum += one.sum;
        rows[y].count += one.count;
      }
    }
  });
  Total all;
  for (const Total& row : rows) {
    all.sum += row.sum;
    all.count += row.count;
  }
  return all.count > 0 ? all.sum / static_cast<double>(all.count) : 1;
}

} // namespace rend
