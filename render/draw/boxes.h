// Draws rectangles of a picture, all at once: their edges lie between pixels, so that neighbours leave no gap
// and share no pixel.
//
// A Device must be current, from construction to destruction.
#pragma once

#include "render/draw/gl.h"
#include "render/draw/pixel_box.h"

#include <vector>

namespace rend {

class Boxes {
public:
  Boxes();
  // With the program in use, whose vertex shader finds places in attribute 0: corners of the picture at -1 and
  // 1.
  void draw(const std::vector<PixelBox>& boxes, int width, int height);

private:
  GlVertexArray array_;
  GlBuffer buffer_;
  std::vector<Eigen::Vector2f> corners_; // two triangles a box
};

} // namespace rend
