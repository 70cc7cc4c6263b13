// `rend help tear`: every criterion with every change, and where the change is made.
#pragma once

#include "render/help/folding.h"

#include <string>

namespace rend {

// Made from what accepts and refuses laws (sim/fracture/pairs.h). `colour` adds terminal codes. A table where
// the page has all of its columns, else a list.
std::string tear_table(bool colour, std::size_t columns = page_columns);

} // namespace rend
