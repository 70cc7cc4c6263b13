// Whether a map still is one.
#pragma once

#include "sim/topology/gmap.h"

#include <string>

namespace rend {

std::string broken_axiom(const GMap& map); // the first that does not hold; empty: all do

} // namespace rend
