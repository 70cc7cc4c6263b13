// Text in lines of a given width.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rend {

// Width of UTF-8 text in terminal columns; assumes no double-width characters.
std::size_t width(std::string_view text);

// Wraps `text` at blanks into lines of at most `columns`; a longer word has a line of its own.
std::vector<std::string> folded(std::string_view text, std::size_t columns);

} // namespace rend
