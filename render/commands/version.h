// rend --version: which rend this is, and with what.
#pragma once

#include <string>

namespace rend {

// Version, commit and compiler; then a line of each library: the one that is loaded where it can be asked, else
// the one that was built with.
std::string version_in_words();

} // namespace rend
