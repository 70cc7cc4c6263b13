// Simple pictures for tests of metrics.
#pragma once

#include "render/compare/picture.h"

#include <cmath>
#include <random>

namespace rend::test {

inline Picture flat(int width, int height, float r, float g, float b) {
  Picture picture;
  picture.width = width;
  picture.height = height;
  const float levels[] = {r, g, b};
  for (std::size_t c = 0; c < 3; ++c) picture.planes[c].assign(picture.pixels(), levels[c]);
  return picture;
}
inline Picture flat(int width, int height, float level) {
  return flat(width, height, level, level, level);
}

inline Picture noise(int width, int height, unsigned seed) {
  Picture picture = flat(width, height, 0);
  std::mt19937 random(seed);
  for (std::size_t c = 0; c < 3; ++c)
    for (float& level : picture.planes[c]) level = static_cast<float>(random() % 256);
  return picture;
}

inline PixelMask every(const Picture& picture, int nth) {
  PixelMask mask;
  mask.counts.assign(picture.pixels(), 1);
  for (std::size_t n = 0; n < mask.counts.size(); n += static_cast<std::size_t>(nth)) mask.counts[n] = 0;
  return mask;
}

} // namespace rend::test
