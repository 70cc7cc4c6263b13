// Names that can do no harm where they are shown.
//
// Names come from outside: of files, bodies, groups, attributes. What of them could act on a terminal or in a
// list stands as an escape: control characters as \n, \t, \x1b, \u{9b} (which begins a terminal's sequence as
// ESC [ does); marks that turn the direction of reading as \u{202e}; bytes that are no UTF-8 as \xff. It is
// not told apart from a name that holds those letters. What is printable stays as it is: twice does no harm.
#pragma once

#include <string>
#include <string_view>

namespace rend {

// `text` may be any bytes.
std::string printable(std::string_view text);                           // on one line
std::string printable_lines(std::string_view text);                     // line ends and tabs stay
std::string printable(std::string_view text, std::string_view instead); // of each that could act

// A whole text of JSON, which is UTF-8: its strings get escapes of JSON, and are read as what they were.
std::string printable_json(std::string_view json);

// The first character of `text`, which is not empty and loses it. Of bytes that are no character, one.
std::string take_printable(std::string_view& text);

} // namespace rend
