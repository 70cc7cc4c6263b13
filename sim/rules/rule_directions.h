// Directions that expressions of rules know: the normal of a face or of a vertex, and the direction of an edge;
// and how fast they turn where vertices move.
//
//   s = ½ Σ x_n × x_n+1 around a face, Σ s over the outer faces at a vertex, x_2 − x_1 of an edge
//   n = s/|s|,   n' = (s' − (s'·n) n)/|s|
//
// Normals need a sense: out of a volume; of a sheet, and of a face in a solid that encloses nothing, the side
// on which its component's smallest dart lies.
#pragma once

#include "sim/embedding/embedded_map.h"
#include "sim/topology/orientation.h"

#include <optional>
#include <string_view>

namespace rend {

struct Direction {
  Vec3 unit;
  Vec3 rate; // [1/s]
};

// `which`: "normal" of its vertex, "face" its normal, "edge". At rest nothing turns. `sides`: of the map, when
// they are known; found where they are needed. ExpressionError: there is no such direction.
Direction direction_at(const Edit& edit, Dart d, std::string_view which, bool at_rest,
                       std::optional<Sides>& sides);

} // namespace rend
