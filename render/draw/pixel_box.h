// A rectangle of a picture.
#pragma once

namespace rend {

struct PixelBox {
  int x = 0, y = 0;          // of its lower left corner, from the picture's [pixels]
  int width = 0, height = 0; // [pixels]
};

} // namespace rend
