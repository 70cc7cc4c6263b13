// Shadows on the floor: the key light's soft shadow, and the contact shadow where something nearly touches the
// floor.
//
// Both are mip pyramids: level 0 is a small picture of the bodies (seen from the light, or from straight
// above), further levels are coarser and blurred. The level is chosen by the height of the occluder above the
// floor, so a shadow is sharp where the occluder touches the floor and soft far from it. That choice is made
// once for each texel of the shade texture, seen from the light; the composite pass reads the shade once a
// pixel.
#pragma once

#include "render/draw/coverage_grid.h"
#include "render/draw/gl.h"
#include "render/draw/light.h"
#include "render/draw/rect_painter.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace rend {

// A texture of two channels (16 bits each) with halved and blurred levels.
class MipPyramid {
public:
  MipPyramid(int side, int levels); // [texels] of level 0; levels includes level 0
  // Renders level 0 by `draw` (bound and cleared, its outermost texels left empty), then each level from the
  // one before. drawn: the bounds of what it draws, in texture coordinates; the rest is not processed. Empty:
  // all levels are cleared.
  void build(const GlProgram& halve, const Eigen::AlignedBox2f& drawn, const std::function<void()>& draw);
  GLuint texture() const { return texture_.name(); }
  int side() const { return side_; }

private:
  int side_;
  GlTexture texture_;
  std::vector<GlFramebuffer> levels_;
};

class FloorShadow {
public:
  FloorShadow();
  // `draw` issues the draw calls of all bodies that cast shadows (positions in attribute 0); these lie in `lit`
  // and have these triangles, three corners each. scale: a characteristic length of the picture [m], by which
  // the reach of contact shadows is chosen. towards_key: unit, above the floor. holes: where some bodies have
  // holes, the texture unit in which `draw` puts the picture of each (places in it in attribute 4).
  void build(double floor_z, double scale, const Eigen::Vector3d& towards_key, const Eigen::AlignedBox3d& lit,
             const std::vector<std::span<const Corner>>& triangles, const std::function<void()>& draw,
             std::optional<int> holes = {});
  // x: the share of key light that is blocked, y: of all light. 256² texels: the square that build() covers,
  // seen along the key light.
  GLuint shade() const { return shade_.name(); }
  // The squares of that texture that any shadow can reach.
  const CoverageGrid& reached() const { return reached_; }
  // From (x, y, 1) on the floor [m] to shade's texture coordinates.
  const Eigen::Matrix<double, 2, 3>& shade_of_floor() const { return shade_of_floor_; }

private:
  struct Views { // matrices from positions of shadow casters to texture coordinates
    Eigen::Matrix<float, 2, 4> key, above,
        below; // along the key light; from above; of the point straight below on the floor, along the key light
    float low; // height below which contact shadows count [m]
    Eigen::Vector2f key_blur, contact_blur; // extents of either pyramid's blur, in key's texture coordinates
  };
  void find_reached(const Views& views, const std::vector<std::span<const Corner>>& triangles);
  void render_blur_levels(double penumbra);
  void render_shade(double contact_level, const Eigen::Matrix<double, 2, 3>& contact_of_floor);

  GlProgram occluder_{"occluder.vert", "occluder.frag"};
  std::optional<GlProgram> cut_out_occluder_; // created for the first frame in which something has holes
  GlProgram halve_{"screen.vert", "halve.frag"};
  GlProgram shade_program_{"boxes.vert", "settle.frag"};
  MipPyramid key_{512, 5}, contact_{256, 5};
  GlProgram blur_level_program_{"screen.vert", "blur.frag"};
  GlTexture blur_, shade_; // one channel: the level of key_ to use; two channels: see shade()
  GlFramebuffer blur_target_, shade_target_;
  Eigen::Matrix<double, 2, 3> shade_of_floor_;
  CoverageGrid reached_{32, 32};
  Eigen::AlignedBox2f key_drawn_, contact_drawn_; // of the pyramids' level 0, in texture coordinates
  RectPainter rect_painter_;
};

} // namespace rend
