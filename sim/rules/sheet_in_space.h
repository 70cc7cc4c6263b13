// A sheet as a map of three dimensions: its faces are those of a solid, with no volume between them yet.
// Rules make volumes on them.
#pragma once

#include "sim/embedding/embedded_map.h"

#include <memory>

namespace rend {

// The same links and points; darts are numbered 0, 1, ... in the order of those of the sheet.
std::unique_ptr<EmbeddedMap> sheet_in_space(const EmbeddedMap& sheet);

} // namespace rend
