// A picture in memory: 8-bit rows, top first, without padding.
//
// Everything after the renderer (PNG, video, comparison) uses this type, so that nothing else needs to know
// that OpenGL returns rows bottom first.
#pragma once

#include "sim/base/check.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rend {

struct Image {
  int width = 0, height = 0;        // [pixels]
  int channels = 3;                 // 3: RGB, 4: RGBA
  std::vector<std::uint8_t> pixels; // sRGB, height x width x channels, row 0 is the top

  Image() = default;
  Image(int width_, int height_, int channels_ = 3)
      : width(width_), height(height_), channels(channels_),
        pixels(static_cast<std::size_t>(width_) * height_ * channels_) {
    CHECK(width > 0 && height > 0);
    CHECK(channels == 3 || channels == 4);
  }

  std::size_t stride() const { return static_cast<std::size_t>(width) * channels; } // bytes per row
  std::uint8_t* row(int y) { return pixels.data() + y * stride(); }
  const std::uint8_t* row(int y) const { return pixels.data() + y * stride(); }
  const std::uint8_t* at(int x, int y) const& { return row(y) + static_cast<std::size_t>(x) * channels; }
  const std::uint8_t* at(int x, int y) const&& = delete; // would point into a temporary image

  bool operator==(const Image&) const = default;
};

} // namespace rend
