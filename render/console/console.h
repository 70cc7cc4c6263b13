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

// Names of files, bodies, groups come from outside, and messages of libraries too: all that is said is made
// printable here (sim/base/printable.h), once. A result has lines of its own, and so a name in one of its lines
// needs printable() where the line is made.

// Whoever read the results has gone (rend help preset | head -1): the program ends, and says nothing of it.
struct NobodyReads {};

// Writes to stdout at once. Throws where that fails: NobodyReads, or UserError (ReadWrite) for a full disk.
void print_result(std::string_view text);
void print_page(std::string_view text); // the same of rend's own words, with its colours

// "rend: error: ..." and below it "  hint: ...", each on one line.
void print_error(const std::string& what, const std::string& hint = {});
void print_note(const std::string& what);
void note_fewer_threads(); // than were wanted: the system starts no more

// On stderr as it is, carriage returns and colours too: names within are to be printable(). Whoever does not
// read it any more misses it.
void print_progress(std::string_view text);

std::string seconds_in_words(double seconds);  // "0.84 s", "12.3 s", "3 min 20 s"
std::string bytes_in_words(std::size_t bytes); // "12.8 kB", of 1000 bytes

} // namespace rend
