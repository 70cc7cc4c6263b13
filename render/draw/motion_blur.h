// Motion blur: the mean of pictures of several moments (Frame::moments), in linear light.
//
// Pictures are drawn one after another, as any other picture, so that what a body hides, its shadow, its gloss
// and smooth edges are right at each moment. (Blurring one picture along velocities is quicker, but has no
// place for what comes into sight, and none for what tears.)
//
// A Device must be current, from construction to destruction.
#pragma once

#include "render/draw/frame.h"
#include "render/draw/gl.h"
#include "render/draw/light_average.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rend {

// The plain frame of a moment, without a HUD. Between two states positions and colours are interpolated
// linearly, and so are normals, which become unit again. CHECK: there are such states; two between which it
// lies have one shape.
Frame frame_at(const Frame& frame, const FrameMoment& moment);

class MotionBlur {
public:
  // Of pictures in the framebuffer `picture`: width, height [pixels]; opaque: alpha means nothing.
  void start(GLuint picture, int width, int height, bool opaque);
  void add(int weight); // the picture that is there now
  void finish();        // leaves the mean there, and the framebuffer bound

private:
  GLuint picture_ = 0;
  int width_ = 0, height_ = 0;
  LightAverage average_;
  std::vector<std::uint8_t> pixels_; // RGBA, bottom row first
  GlTexture mean_;
  GlFramebuffer mean_target_;
};

} // namespace rend
