// A map of values from 0 to 1 as a picture: black over violet and orange to pale yellow (magma), as FLIP's
// authors show theirs. Brightness grows with the value throughout, so that it reads in grey as well.
#pragma once

#include "render/compare/picture.h"
#include "render/files/image.h"

namespace rend {

// What the mask leaves out is grey.
Image heat_of(const Levels& map, int width, int height, const Mask& mask);

} // namespace rend
