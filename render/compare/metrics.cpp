#include "render/compare/metrics.h"

#include "render/compare/antialiasing.h"
#include "render/compare/flip.h"
#include "render/compare/percentile.h"
#include "render/compare/ssim.h"
#include "sim/base/check.h"

#include <algorithm>

namespace rend {
namespace {

FlipFigures flip_figures(const Levels& map, const PixelMask& mask) {
  std::vector<float> counted;
  counted.reserve(map.size());
  for (std::size_t n = 0; n < map.size(); ++n)
    if (mask[n]) counted.push_back(map[n]);
  if (counted.empty()) return {};
  FlipFigures out;
  double sum = 0;
  for (const float value : counted) sum += value;
  out.mean = sum / static_cast<double>(counted.size());
  out.max = *std::max_element(counted.begin(), counted.end());
  constexpr double percents[] = {25, 50, 75};
  const std::vector<float> found = weighted_percentiles(counted, percents);
  out.quartile = found[0];
  out.median = found[1];
  out.upper = found[2];
  return out;
}

} // namespace

namespace {

// By what is seen: over white, as pixelmatch does.
PixelMask compared_pixels(const Picture& a, const Picture& b, const PixelMask& mask, Metrics& out) {
  if (!a.alpha && !b.alpha) return without_smoothed(a, b, mask, out.smoothed);
  return without_smoothed(over_white(a), over_white(b), mask, out.smoothed);
}

} // namespace

Metrics measure(Picture a, Picture b, const PixelMask& given, const MeasureOptions& options) {
  CHECK(a.width == b.width && a.height == b.height);
  if (a.alpha || b.alpha) {
    add_alpha(a);
    add_alpha(b);
  }
  Metrics out;
  const PixelMask mask = options.leave_out_smoothed ? compared_pixels(a, b, given, out) : given;
  mask_out(mask, a, b);
  out.difference = difference_of(a, b, mask, options.threads);
  out.over = over_threshold(out.difference, a.width, a.height, options.threshold, options.window_side);
  if (out.difference.differing == 0) return out; // equal pictures: SSIM is 1, FLIP 0
  a = over_white(std::move(a));
  b = over_white(std::move(b));
  out.ssim = ssim_of(a, b, mask, options.threads);
  out.flip_map = flip_map(a, b, options.threads);
  out.flip = flip_figures(out.flip_map, mask);
  constexpr int side = 16;
  const Pixel corner = brightest_window(out.flip_map, a.width, a.height, side);
  out.worst = {corner.x + std::min(side, a.width) / 2, corner.y + std::min(side, a.height) / 2};
  return out;
}

} // namespace rend
