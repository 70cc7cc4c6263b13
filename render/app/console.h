// What is said to the user: results on stdout, all else on stderr.
#pragma once

#include "sim/base/error.h"

#include <cstdio>
#include <string>
#include <string_view>

namespace rend {

// Descriptors 0 to 2 that the program was started without are taken, so that no file that it opens gets one of
// them and is mistaken for what is said. Reading and writing there fails as if they were closed.
void keep_standard_streams();

bool is_terminal(std::FILE* stream);
bool wants_colour(std::FILE* stream); // a terminal that knows colours, and NO_COLOR is not set

// Writes to stdout at once. Throws UserError (ReadWrite) where that fails: a closed pipe, a full disk.
void print_result(std::string_view text);

// "rend: error: ..." and below it "  hint: ...".
void print_error(const std::string& what, const std::string& hint = {});
void print_note(const std::string& what);
void note_fewer_threads(); // than were wanted: the system starts no more

std::string seconds_in_words(double seconds);  // "0.84 s", "12.3 s", "3 min 20 s"
std::string bytes_in_words(std::size_t bytes); // "12.8 kB", of 1000 bytes

} // namespace rend
