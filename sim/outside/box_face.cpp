#include "sim/outside/box_face.h"

#include <algorithm>
#include <limits>

namespace rend {
namespace {

constexpr double parallel_edges = 1e-9; // relative to the length of the edge: their product has no direction

} // namespace

BoxSeparation separation(const Box& box, const TriangleCorners& x) {
  const Vec3 half = 0.5 * (box.high - box.low), centre = box.middle();
  const TriangleCorners y{x[0] - centre, x[1] - centre, x[2] - centre};
  BoxSeparation best{.plane = {}, .distance = -std::numeric_limits<double>::infinity()};
  const auto take = [&](const Vec3& normal) { // unit
    const double reach = half.dot(normal.cwiseAbs());
    const std::array<double, 3> at{normal.dot(y[0]), normal.dot(y[1]), normal.dot(y[2])};
    const auto [low, high] = std::minmax_element(at.begin(), at.end());
    const double above = *low - reach, below = -*high - reach;
    if (std::max(above, below) <= best.distance) return;
    best.distance = std::max(above, below);
    best.plane.normal = above >= below ? normal : Vec3(-normal);
    best.plane.offset = reach + best.plane.normal.dot(centre);
  };
  for (int axis = 0; axis < 3; ++axis) take(Vec3::Unit(axis));
  const Vec3 across = (y[1] - y[0]).cross(y[2] - y[0]);
  if (const double area = across.norm(); area > 0) take(across / area);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 edge = y[(k + 1) % 3] - y[k];
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 product = edge.cross(Vec3(Vec3::Unit(axis)));
      if (const double size = product.norm(); size > parallel_edges * edge.norm()) take(product / size);
    }
  }
  return best;
}

} // namespace rend
