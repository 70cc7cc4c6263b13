// `rend help tear`: every criterion with every change, and where the change is made, at most 100 columns wide.
#pragma once

#include <string>

namespace rend {

// Made from what accepts and refuses laws (sim/fracture/pairs.h). `colour` adds terminal codes.
std::string tear_table(bool colour);

} // namespace rend
