// A drawing as SVG 1.1 (W3C 2011). The same drawing gives the same bytes.
#pragma once

#include "render/diagram/drawing.h"

namespace rend {

std::string svg_text(const Drawing& drawing);

} // namespace rend
