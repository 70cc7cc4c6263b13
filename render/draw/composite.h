// The last render pass: resolves the bodies' samples, multiplies in ambient occlusion, and puts the studio
// (floor and backdrop) behind them.
//
// It is one pass instead of four: no intermediate rounding, and each pixel is written once. Samples are read
// only in blocks that bodies may cover, and the shadow is looked up only where it may reach the floor: for the
// rest, most of the picture, a pixel costs a few multiplications.
//
// A Device must be current, from construction to destruction.
#pragma once

#include "render/draw/body_targets.h"
#include "render/draw/coverage_grid.h"
#include "render/draw/floor_shadow.h"
#include "render/draw/occlusion.h"
#include "render/draw/rect_painter.h"

#include <map>

namespace rend {

class Composite {
public:
  Composite(int width, int height) : width_(width), height_(height) {} // [pixels]

  // Into the bound framebuffer, which has that size. bodies: always with the same number of samples; shadow: of
  // the frame's floor, if it has one; occlusion: of these bodies, or null. blocks: those that bodies cover.
  void draw(const Frame& frame, const View& view, const BodyTargets& bodies, const CoverageGrid& blocks,
            const FloorShadow& shadow, const Occlusion* occlusion);

private:
  enum class Background { Nothing = 0, Backdrop = 1, Floor = 2, FloorInShadow = 3, ShadowAlone = 4 };
  struct Kind { // a variant of the program
    bool bodies, occluded;
    Background background;
    auto operator<=>(const Kind&) const = default;
  };

  const GlProgram& program(const Kind& kind, const BodyTargets& bodies);

  int width_, height_;
  std::map<Kind, GlProgram> programs_; // compiled on first use
  RectPainter rect_painter_;
};

} // namespace rend
