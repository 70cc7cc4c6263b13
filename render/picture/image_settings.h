// <image>: the pictures' size, how many there are, and what is behind the bodies.
#pragma once

#include "render/picture/colour.h"

#include <array>
#include <optional>

namespace rend {

struct ImageSettings {
  std::array<int, 2> size{1280, 720};                          // width and height [pixels]
  double fps = 30;                                             // pictures a second of simulated time [1/s]
  int samples = 4;                                             // a pixel: 1, 4 or 16
  std::optional<Colour> background = Colour{0xed, 0xef, 0xf3}; // none: transparent, without floor
  bool occlusion = false;                                      // ambient occlusion
  SettingsSource source = {};

  int width() const { return size[0]; }
  int height() const { return size[1]; }
  double aspect() const { return static_cast<double>(size[0]) / size[1]; }
  bool transparent() const { return !background; }
};
template <> const Fields<ImageSettings>& fields_of();

} // namespace rend
