// Letters as an outline, of the font that is embedded (sim/font/font.h), in its weight SemiBold.
#pragma once

#include "sim/mesh/outline.h"

#include <stdexcept>
#include <string>

namespace rend {

// Why a text has no outline, and what would do.
struct TextFault : std::invalid_argument {
  TextFault(const std::string& what, const std::string& hint_) : std::invalid_argument(what), hint(hint_) {}
  std::string hint;
};

struct TextOutline {
  Outline outline; // on the line y = 0; the height of the font is 1
  int letters = 0; // each of which is one connected region; without blanks
};

// TextFault: nothing but blanks, a letter that the font lacks or that consists of several parts, as "i" does;
// rend was built without the font.
TextOutline outline_of_text(const std::string& text);

} // namespace rend
