// Text in lines of a given width.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rend {

constexpr std::size_t page_columns = 100; // the width of help where nothing narrower is asked for

// Width of UTF-8 text in terminal columns; assumes no double-width characters.
std::size_t width(std::string_view text);

// Wraps `text` at spaces into lines of at most `columns`; a longer word has a line of its own. Line ends stay:
// what follows the first one is a list, a line for each value, whose further lines are indented by two.
std::vector<std::string> folded(std::string_view text, std::size_t columns);

// The same text with "; " where it has line ends, for what must be one line.
std::string on_one_line(std::string_view text);

// A finished page, with every line longer than `columns` wrapped below its own indentation.
std::string fitted(std::string_view page, std::size_t columns);

} // namespace rend
