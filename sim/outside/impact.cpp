#include "sim/outside/impact.h"

#include <algorithm>
#include <cmath>

namespace rend {

Impulse impact(const Vec3& u, const Vec3& normal, double friction, const Vec3& inverse_masses) {
  Impulse out;
  const double lost = std::max(0.0, -u.dot(normal)), along = inverse_mass_along(normal, inverse_masses);
  if (lost == 0 || along == 0) return out;
  out.normal = lost / along * normal;
  const Vec3 after = u + inverse_masses.cwiseProduct(out.normal);
  const Vec3 sliding = after - after.dot(normal) * normal;
  const double square = sliding.squaredNorm(), across = sliding.dot(inverse_masses.cwiseProduct(sliding));
  if (across > 0)
    out.friction = -std::min(square / across, friction * lost / (along * std::sqrt(square))) * sliding;
  return out;
}

double way_out(double before, double step) {
  constexpr double relaxation = 0.05; // [s]
  constexpr double fastest_out = 0.1; // [m/s]
  return before > 0 ? before - std::min(before * std::min(1.0, step / relaxation), fastest_out * step) : 0;
}

} // namespace rend
