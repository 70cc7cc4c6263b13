// A picture whose brightness an expression of places may use: where a body is weak, say, or heavy.
//
// It holds numbers, made by whoever reads pictures (render/picture/mask_file.h): nothing here knows a format.
// Between the middles of pixels it is bilinear,
//
//   b(u, v) = Σ over the 4 pixels around (u w, (1 − v) h) of b Π_k (1 − |distance_k|)      distances in pixels
//
// and beyond its sides as at the nearest place on them.
#pragma once

#include "sim/embedding/texture_coordinates.h"

#include <cstddef>
#include <vector>

namespace rend {

struct Mask {
  int width = 0, height = 0;     // [pixels], above 0
  std::vector<float> brightness; // 0 black to 1 white; height x width, row 0 is the top

  double aspect() const { return static_cast<double>(width) / height; }
  double at(const TexturePlace& place) const; // 0 to 1; CHECK: it has a pixel
};

} // namespace rend
