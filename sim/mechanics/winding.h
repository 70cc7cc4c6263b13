// Orientation of a face as seen from outside its volume; from the rest state, so that it does not change with
// motion.
#pragma once

#include "sim/embedding/embedded_map.h"

#include <string_view>

namespace rend {

// Words that stay within one orientation class of a volume's darts: to the next side of the face, and across
// the side to the adjacent face.
inline constexpr std::string_view to_next_side = "01", to_next_face = "20";

// Twice the area of the face at rest times its normal [m²], counter-clockwise from d over α0(d).
Vec3 rest_area_vector(const EmbeddedMap& map, Dart d);

// Whether the face of d, walked from d over α0(d), is counter-clockwise as seen from outside its volume: by the
// sign of the volume at rest, which is exact for every closed polyhedron, convex or not. A volume of 0 counts
// as outward.
bool winds_outward(const EmbeddedMap& map, Dart d);

} // namespace rend
