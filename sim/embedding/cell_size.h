// The rest size of a cell.
#pragma once

#include "sim/embedding/embedded_map.h"

namespace rend {

// [m²], of the face of d (if warped: of its triangle fan around the mean of its corners).
double rest_area(const EmbeddedMap& map, Dart d);

// [m³], of the volume of d, each face taken as its triangle fan around the mean of its corners: exact for
// planar faces.
double rest_volume(const EmbeddedMap& map, Dart d);

int corners_of_volume(const GMap& map, Dart d);

} // namespace rend
