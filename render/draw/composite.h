// The last pass: brings the bodies' samples to one a pixel, takes from them what occlusion keeps, and puts the
// studio (floor and backdrop) behind them.
//
// One pass instead of four: the samples are read where they are wanted, nothing is rounded in between, and a
// pixel is written once. Only where bodies may be are samples looked at, and only where the floor may lie in a
// shadow is that looked up: the rest, most of the picture, is a few products a pixel.
//
// A Device must be current, from construction to destruction.
#pragma once

#include "render/draw/bodies_picture.h"
#include "render/draw/boxes.h"
#include "render/draw/floor_shadow.h"
#include "render/draw/occlusion.h"
#include "render/draw/pixel_footprint.h"

#include <map>

namespace rend {

class Composite {
public:
  Composite(int width, int height) : width_(width), height_(height) {} // [pixels]

  // Into the bound framebuffer, of that size. bodies: always with as many samples; shadow: of the frame's
  // floor, if it has one; occlusion: of these bodies, null without. blocks: those that bodies cover.
  void draw(const Frame& frame, const View& view, const BodiesPicture& bodies, const Footprint& blocks,
            const FloorShadow& shadow, const Occlusion* occlusion);

private:
  enum class Behind { Nothing = 0, Backdrop = 1, Floor = 2, FloorInShadow = 3 };
  struct Kind { // of program
    bool bodies, occluded;
    Behind behind;
    auto operator<=>(const Kind&) const = default;
  };

  const GlProgram& program(const Kind& kind, const BodiesPicture& bodies);

  int width_, height_;
  std::map<Kind, GlProgram> programs_; // compiled when they are first needed
  Boxes boxes_;
};

} // namespace rend
