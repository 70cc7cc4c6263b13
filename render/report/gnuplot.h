// Runs gnuplot as a filter: a script in, a picture out. It is an external program (Debian: gnuplot-nox), found
// in PATH and started without a shell.
#pragma once

#include <optional>
#include <string>

namespace rend {

// What gnuplot wrote to its standard output. None if it is not installed. Throws UserError (ReadWrite) with its
// messages if it fails or writes nothing.
std::optional<std::string> run_gnuplot(const std::string& script);

} // namespace rend
