// Heat map: values from 0 to 1 as a picture, in the colours of magma (black over violet and orange to pale
// yellow), as FLIP's authors show theirs. Lightness grows with the value throughout, so that it can be read in
// grey as well.
#pragma once

#include "render/compare/picture.h"
#include "render/files/image.h"

namespace rend {

// Masked pixels are grey.
Image heat_of(const Levels& map, int width, int height, const PixelMask& mask);

} // namespace rend
