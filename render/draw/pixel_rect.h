// A rectangle of pixels.
#pragma once

namespace rend {

struct PixelRect {
  int x = 0, y = 0;          // [pixels], lower left corner, from that of the picture
  int width = 0, height = 0; // [pixels]
};

} // namespace rend
