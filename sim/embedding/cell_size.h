// How large a cell is at rest.
#pragma once

#include "sim/embedding/embedded_map.h"

namespace rend {

// [m²], of the face of d (a warped one: of its fan from the centre).
double rest_area(const EmbeddedMap& map, Dart d);

// [m³], of the volume of d, each face taken as its fan from the mean of its corners: exact where faces are
// flat.
double rest_volume(const EmbeddedMap& map, Dart d);

int corners_of_volume(const GMap& map, Dart d);

} // namespace rend
