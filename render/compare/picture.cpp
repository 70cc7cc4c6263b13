#include "render/compare/picture.h"

#include "sim/base/check.h"

#include <algorithm>

namespace rend {

Picture picture_of(const HighDepthImage& image) {
  Picture out;
  out.width = image.width;
  out.height = image.height;
  out.alpha = image.channels == 4;
  const float unit = image.bits == 16 ? 257.f : 1.f; // samples per level
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t c = 0; c < channels; ++c) {
    Levels& plane = out.planes[c];
    plane.resize(out.pixels());
    const std::uint16_t* from = image.samples.data() + c;
    for (std::size_t n = 0; n < plane.size(); ++n) plane[n] = static_cast<float>(from[n * channels]) / unit;
  }
  if (!out.alpha) return out;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t n = 0; n < out.pixels(); ++n) out.planes[c][n] *= out.planes[3][n] / 255.f;
  return out;
}

Picture over_white(Picture picture) {
  if (!picture.alpha) return picture;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t n = 0; n < picture.pixels(); ++n) picture.planes[c][n] += 255.f - picture.planes[3][n];
  picture.planes[3] = Levels(); // assigning {} would keep the capacity
  picture.alpha = false;
  return picture;
}

PixelMask mask_of(const Picture& picture) {
  PixelMask mask;
  mask.counts.resize(picture.pixels());
  for (std::size_t n = 0; n < mask.counts.size(); ++n) mask.counts[n] = picture.planes[0][n] >= 127.5f ? 1 : 0;
  return mask;
}

void mask_out(const PixelMask& mask, const Picture& a, Picture& b) {
  CHECK(a.alpha == b.alpha && a.pixels() == b.pixels());
  if (mask.counts.empty()) return;
  CHECK(mask.counts.size() == a.pixels());
  for (std::size_t c = 0; c < (a.alpha ? 4u : 3u); ++c)
    for (std::size_t n = 0; n < a.pixels(); ++n)
      if (mask.counts[n] == 0) b.planes[c][n] = a.planes[c][n];
}

void add_alpha(Picture& picture) {
  if (picture.alpha) return;
  picture.planes[3].assign(picture.pixels(), 255.f);
  picture.alpha = true;
}

} // namespace rend
