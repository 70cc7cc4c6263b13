// Output for the user: results on stdout, everything else on stderr.
#pragma once

#include "sim/base/error.h"

#include <cstdio>
#include <string>
#include <string_view>

namespace rend {

// Opens standard descriptors 0 to 2 that were closed when the program started, so that no file opened later
// gets one of them and receives messages. Reading and writing there still fails.
void keep_standard_streams();

bool is_terminal(std::FILE* stream);
bool wants_colour(std::FILE* stream); // a terminal that knows colours, and NO_COLOR is not set

// Names of files, bodies and groups, and messages of libraries, are untrusted text: everything is made
// printable here (sim/base/printable.h), once. Results consist of lines; a name within a line needs printable()
// when the line is made.

// Thrown when the reader of the results has closed the pipe (rend help preset | head -1): the program ends
// silently.
struct BrokenPipe {};

// Writes to stdout and flushes. Throws where that fails: BrokenPipe, or UserError (ReadWrite) for a full disk.
void print_result(std::string_view text);
void print_trusted_result(std::string_view text); // rend's own text, with its colour codes

// "rend: error: ..." and below it "  hint: ...", each on one line.
void print_error(const std::string& what, const std::string& hint = {});
void print_note(const std::string& what);
void note_fewer_threads(); // a note that the system refused to start as many threads as were asked for

// Written to stderr unchanged, carriage returns and colour codes included: names in it must be printable()
// already. Errors are ignored.
void print_progress(std::string_view text);

std::string seconds_in_words(double seconds);  // "0.84 s", "12.3 s", "3 min 20 s"
std::string bytes_in_words(std::size_t bytes); // "12.8 kB", of 1000 bytes each

} // namespace rend
