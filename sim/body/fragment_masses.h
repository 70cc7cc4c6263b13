// How large the connected pieces of a body are.
#pragma once

#include "sim/mechanics/mass.h"

#include <vector>

namespace rend {

// [kg], one per fragment, in the order of their smallest darts: sums over corners. Walks the map.
std::vector<double> fragment_masses(const EmbeddedMap& map, const MassColumn& mass);

} // namespace rend
