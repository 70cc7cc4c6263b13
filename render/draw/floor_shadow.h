// What bodies keep from the floor: the key light's soft shadow, and the dark where something nearly touches.
//
// Both are pyramids: a small picture of the bodies (seen from the light, or from straight above), and the same
// ever coarser and more blurred. The floor picks a level by how high the thing is that throws the shadow, so a
// shadow is sharp at its foot and soft far from it. That choice is made once for each texel of the shade, seen
// from the light, and the floor reads it once a pixel.
#pragma once

#include "render/draw/boxes.h"
#include "render/draw/gl.h"
#include "render/draw/light.h"
#include "render/draw/pixel_footprint.h"

#include <functional>
#include <span>
#include <vector>

namespace rend {

// A texture of two channels (16 bits each) with halved and blurred levels.
class Pyramid {
public:
  Pyramid(int side, int levels); // [texels] of level 0; levels counts level 0
  // Draws level 0 by `draw` (bound and cleared, its rim left empty), then the others out of it. drawn: what it
  // draws, in texture coordinates; elsewhere nothing is looked at. Empty: all is cleared.
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
  // `draw` issues the draw calls of all bodies that throw shadows (positions in attribute 0), which lie in
  // `lit` and have these triangles, three corners each. scale: a length that belongs to the picture [m]:
  // contact is seen within a small part of it. towards_key: unit, above the floor.
  void build(double floor_z, double scale, const Eigen::Vector3d& towards_key, const Eigen::AlignedBox3d& lit,
             const std::vector<std::span<const Corner>>& triangles, const std::function<void()>& draw);
  // x: the share of key light kept away, y: of all light. 256² texels: the square of build(), seen along the
  // key.
  GLuint shade() const { return shade_.name(); }
  // Squares of that texture beyond which nothing is kept from the floor.
  const Footprint& reached() const { return reached_; }
  // From (x, y, 1) on the floor [m] to shade's texture coordinates.
  const Eigen::Matrix<double, 2, 3>& shade_of_floor() const { return shade_of_floor_; }

private:
  struct Views { // of what throws shadows, to texture coordinates
    Eigen::Matrix<float, 2, 4> key, above,
        below; // along the key; from above; of what is straight below, along the key
    float low; // height under which contact counts [m]
    Eigen::Vector2f key_blur, contact_blur; // how far either pyramid is blurred, in key's texture coordinates
  };
  void find_reached(const Views& views, const std::vector<std::span<const Corner>>& triangles);
  void choose_blur(double penumbra);
  void settle(double contact_level, const Eigen::Matrix<double, 2, 3>& contact_of_floor);

  GlProgram occluder_{"occluder.vert", "occluder.frag"};
  GlProgram halve_{"screen.vert", "halve.frag"};
  GlProgram settle_{"boxes.vert", "settle.frag"};
  Pyramid key_{512, 5}, contact_{256, 5};
  GlProgram choose_{"screen.vert", "blur.frag"};
  GlTexture blur_, shade_; // one channel: which level of key_ is the shadow; two: see shade()
  GlFramebuffer blur_target_, shade_target_;
  Eigen::Matrix<double, 2, 3> shade_of_floor_;
  Footprint reached_{32, 32};
  Eigen::AlignedBox2f key_drawn_, contact_drawn_; // of the pyramids' level 0, in texture coordinates
  Boxes boxes_;
};

} // namespace rend
