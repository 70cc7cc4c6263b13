#include "sim/boundary/boundary_triangle.h"

#include "sim/mechanics/winding.h"

namespace rend {

std::array<Dart, 3> corner_darts(const GMap& map, const BoundaryTriangle& triangle) {
  const Dart centre = triangle.turned ? map.alpha(1, triangle.first) : triangle.first;
  Dart second = map.follow(centre, to_next_side);
  for (std::uint32_t n = 0; n < triangle.number; ++n) second = map.follow(second, to_next_side);
  return {centre, second, map.follow(second, to_next_side)};
}

} // namespace rend
