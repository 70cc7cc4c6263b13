// A drawing as a picture: anti-aliased, each part over those before it. Text is in the embedded font.
//
// Everything becomes polygons. A polygon's share of a pixel is measured on five lines across it, exactly
// along each line; colours are mixed by that share as they are stored, without gamma, as browsers do.
#pragma once

#include "render/diagram/drawing.h"
#include "render/files/image.h"

namespace rend {

// `scale`: pixels of the picture in one of the drawing. UserError: rend was built without the font (Usage), or
// a side has more than 8192 pixels (BadInput).
Image paint(const Drawing& drawing, double scale);

} // namespace rend
