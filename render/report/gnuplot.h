// gnuplot as a filter: a script in, a picture out. It is a program of its own (Debian: gnuplot-nox), looked for
// in PATH and started without a shell.
#pragma once

#include <optional>
#include <string>

namespace rend {

// What gnuplot wrote to its standard output. None where it is not installed. Throws UserError (ReadWrite) with
// what it said where it fails or draws nothing.
std::optional<std::string> run_gnuplot(const std::string& script);

} // namespace rend
