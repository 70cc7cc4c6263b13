#include "render/compare/antialiasing.h"

#include "sim/base/check.h"

#include <algorithm>

namespace rend {
namespace {

// The pixels around (x, y) within the picture, without itself.
template <class F> void each_neighbour(const Picture& picture, int x, int y, F&& f) {
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, picture.height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, picture.width - 1); ++u)
      if (u != x || v != y) f(u, v);
}

std::size_t index_of(const Picture& picture, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
}

bool on_border(const Picture& picture, int x, int y) {
  return x == 0 || y == 0 || x == picture.width - 1 || y == picture.height - 1;
}

bool same_colour(const Picture& picture, std::size_t m, std::size_t n) {
  return picture.planes[0][m] == picture.planes[0][n] && picture.planes[1][m] == picture.planes[1][n] &&
         picture.planes[2][m] == picture.planes[2][n];
}

// Y of YIQ, as pixelmatch has it [levels].
float brightness(const Picture& picture, std::size_t n) {
  return 0.29889531f * picture.planes[0][n] + 0.58662247f * picture.planes[1][n] +
         0.11448223f * picture.planes[2][n];
}

bool lies_in_an_area(const Picture& picture, int x, int y) {
  const std::size_t at = index_of(picture, x, y);
  int same = on_border(picture, x, y) ? 1 : 0;
  each_neighbour(picture, x, y,
                 [&](int u, int v) { same += same_colour(picture, at, index_of(picture, u, v)); });
  return same > 2;
}

bool is_smoothed(const Picture& picture, int x, int y, const Picture& other) {
  const float here = brightness(picture, index_of(picture, x, y));
  int equal = on_border(picture, x, y) ? 1 : 0;
  float least = 0, most = 0;
  Pixel darkest, brightest;
  each_neighbour(picture, x, y, [&](int u, int v) {
    const float change = here - brightness(picture, index_of(picture, u, v));
    if (change == 0) {
      ++equal;
    } else if (change < least) {
      least = change;
      brightest = {u, v};
    } else if (change > most) {
      most = change;
      darkest = {u, v};
    }
  });
  if (equal > 2 || least == 0 || most == 0) return false;
  const auto in_both = [&](const Pixel& p) {
    return lies_in_an_area(picture, p.x, p.y) && lies_in_an_area(other, p.x, p.y);
  };
  return in_both(brightest) || in_both(darkest);
}

} // namespace

PixelMask without_smoothed(const Picture& a, const Picture& b, const PixelMask& mask, std::size_t& left_out) {
  CHECK(a.width == b.width && a.height == b.height && !a.alpha && !b.alpha);
  PixelMask out = mask;
  if (out.counts.empty()) out.counts.assign(a.pixels(), 1);
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const std::size_t n = index_of(a, x, y);
      if (!out[n]) continue;
      bool differs = false;
      for (std::size_t c = 0; c < 3; ++c) differs = differs || a.planes[c][n] != b.planes[c][n];
      if (!differs || (!is_smoothed(a, x, y, b) && !is_smoothed(b, x, y, a))) continue;
      out.counts[n] = 0;
      ++left_out;
    }
  return out;
}

} // namespace rend
