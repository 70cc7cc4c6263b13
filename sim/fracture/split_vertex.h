// Whether split-vertex (change.h) would part anything.
#pragma once

#include "sim/fracture/change.h"

namespace rend {

// Whether elements lie on both sides of the plane at the vertex with these darts, and are connected across it.
bool can_be_split(const ForceView& view, const FoundPlace& found, std::span<const Dart> darts);

} // namespace rend
