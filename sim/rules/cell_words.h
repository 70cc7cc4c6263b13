// What a hook stands for, in words: the cell that its orbit is.
#pragma once

#include "sim/topology/orbit.h"

#include <string>

namespace rend {

// "edge". See the table in sim/README.md, "The map".
std::string cell_in_words(Orbit orbit);

} // namespace rend
