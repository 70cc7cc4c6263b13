#include "render/draw/picture_image.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace rend {
namespace {

// RGBA to RGB. Copies four bytes at once, of which the last is overwritten by the next pixel: three times as
// fast.
void drop_alpha(const std::uint8_t* from, std::uint8_t* to, int pixels) {
  for (int x = 0; x + 1 < pixels; ++x) std::memcpy(to + std::ptrdiff_t{3} * x, from + std::ptrdiff_t{4} * x, 4);
  std::memcpy(to + std::ptrdiff_t{3} * (pixels - 1), from + std::ptrdiff_t{4} * (pixels - 1), 3);
}

// From premultiplied to straight alpha, as PNG has it.
void unmultiply(const std::uint8_t* from, std::uint8_t* to, int pixels) {
  for (int x = 0; x < pixels; ++x, from += 4, to += 4) {
    const int alpha = from[3];
    for (int c = 0; c < 3; ++c)
      to[c] = alpha == 0 ? 0 : static_cast<std::uint8_t>(std::min(255, (from[c] * 255 + alpha / 2) / alpha));
    to[3] = from[3];
  }
}

} // namespace

Image picture_image(std::span<const std::uint8_t> pixels, int width, int height, bool transparent) {
  Image image(width, height, transparent ? 4 : 3);
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* from = pixels.data() + static_cast<std::size_t>(height - 1 - y) * width * 4;
    (transparent ? unmultiply : drop_alpha)(from, image.row(y), width);
  }
  return image;
}

} // namespace rend
