// rend --version: the version, the build and its libraries.
#pragma once

#include <string>

namespace rend {

// Version, commit and compiler; then a line for each library: the version loaded at run time where the library
// reports it, else the version it was built with.
std::string version_in_words();

} // namespace rend
