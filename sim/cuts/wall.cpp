#include "sim/cuts/wall.h"

namespace rend {

// I. Sutherland, G. Hodgman, Reentrant polygon clipping, Comm. ACM 1974.
std::vector<Vec3> clipped(std::span<const Vec3> polygon, const OrientedPlane& plane, double slack) {
  std::vector<Vec3> out;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Vec3 &a = polygon[n], &b = polygon[(n + 1) % polygon.size()];
    const double at_a = plane.height(a) - slack, at_b = plane.height(b) - slack;
    if (at_a <= 0) out.push_back(a);
    if ((at_a <= 0) != (at_b <= 0)) out.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return out;
}

} // namespace rend
