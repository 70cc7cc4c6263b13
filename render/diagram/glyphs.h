// Outlines of letters, in the font that is embedded (sim/font/font.h).
#pragma once

#include "render/diagram/drawing.h"

#include <string>
#include <vector>

namespace rend {

using Contours = std::vector<std::vector<Spot>>; // closed; a contour of the other sense is a hole

// UserError (Usage): rend was built without the font.
void require_glyphs();

// Of UTF-8 text whose baseline begins at `at`; `size` is the height of the font [pixels].
std::vector<Contours> glyphs_of(const std::string& text, double size, bool bold, Spot at);
double width_of_glyphs(const std::string& text, double size, bool bold);

} // namespace rend
