// Text from outside made safe to show: names of files, bodies, groups, attributes.
//
// What could act on a terminal or in a list is escaped: control characters as \n, \t, \x1b, \u{9b} (which
// begins a terminal sequence as ESC [ does); marks that change the direction of reading as \u{202e}; bytes that
// are not UTF-8 as \xff. The escape of such a character is not distinguished from a name that holds those
// letters. Printable text stays as it is, so that applying the function twice changes nothing.
#pragma once

#include <string>
#include <string_view>

namespace rend {

// `text` may be any bytes.
std::string printable(std::string_view text);       // on one line
std::string printable_lines(std::string_view text); // line ends and tabs stay
// `instead` replaces each such character
std::string printable(std::string_view text, std::string_view instead);

// A whole JSON text in UTF-8: characters inside its strings become JSON escapes, so that they are parsed as the
// same strings.
std::string printable_json(std::string_view json);

// Removes the first character from `text`, which is not empty, and returns it in printable form. An invalid
// byte counts as one character.
std::string take_printable(std::string_view& text);

} // namespace rend
