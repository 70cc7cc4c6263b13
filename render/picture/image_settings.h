// <image>: the pictures' size, how many there are, at which times, and what is behind the bodies.
#pragma once

#include "render/picture/colour.h"
#include "render/picture/playback.h"

#include <array>
#include <optional>

namespace rend {

struct ImageSettings {
  std::array<int, 2> size{1280, 720}; // width and height [pixels]
  double fps = 30;                    // pictures a second of the clip [1/s]
  double speed = 1;                   // seconds of simulation in a second of the clip
  double shutter =
      0; // motion blur: for which share of the time between two frames the shutter is open; 0: none
  int shutter_samples = 8; // moments of that time of which a picture is the mean
  int samples = 4;         // a pixel: 1, 4 or 16
  std::optional<Colour> background = Colour{0xed, 0xef, 0xf3}; // none: transparent, without floor
  bool floor_shadow = false; // without a background: shadows on the floor are kept, in the alpha channel
  bool occlusion = false;    // ambient occlusion
  std::vector<SpeedKey> speed_keys = {}; // in order of time; where there are some, the speed is what they say
  SettingsSource source = {};

  int width() const { return size[0]; }
  int height() const { return size[1]; }
  double aspect() const { return static_cast<double>(size[0]) / size[1]; }
  bool transparent() const { return !background; }
  Playback playback() const { return {speed, speed_keys}; } // UserError: keys out of order
};
template <> const Fields<ImageSettings>& fields_of();

// UserError for what cannot be together: a speed for the whole clip beside keys, keys out of order, samples of
// a shutter that is not there, the shadows of a floor that is seen itself.
void check_image(const ImageSettings& image);

} // namespace rend
