// Draws rectangles of pixels in one call. Their edges lie on pixel borders, so that adjacent rectangles neither
// leave a gap nor share a pixel.
#pragma once

#include "render/draw/gl.h"
#include "render/draw/pixel_rect.h"

#include <vector>

namespace rend {

class RectPainter {
public:
  RectPainter();
  // Needs a program in use whose vertex shader takes positions from attribute 0, in normalized device
  // coordinates (corners of the picture at -1 and 1).
  void draw(const std::vector<PixelRect>& boxes, int width, int height);

private:
  GlVertexArray array_;
  GlBuffer buffer_;
  std::vector<Eigen::Vector2f> corners_; // two triangles per rectangle
};

} // namespace rend
