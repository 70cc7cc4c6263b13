#include "sim/mechanics/hinge_law.h"

#include "sim/base/math.h"

#include <cmath>

namespace rend {
namespace {

double wrapped(double angle) { // into (−π, π]
  if (angle > pi) return angle - 2 * pi;
  if (angle <= -pi) return angle + 2 * pi;
  return angle;
}

} // namespace

double hinge_angle(const HingePoints& x) {
  const Vec3 hinge = x[1] - x[0];
  const double length = hinge.norm();
  if (length == 0) return 0;
  // From the hinge to the middle of each side's outer vertices: in the plane of the triangle (hinge, face centre).
  const Vec3 one = 0.5 * ((x[2] - x[0]) + (x[3] - x[0]));
  const Vec3 two = 0.5 * ((x[6] - x[0]) + (x[7] - x[0]));
  const Vec3 n1 = hinge.cross(one), n2 = two.cross(hinge);
  return arc_tangent(n1.cross(n2).dot(hinge) / length, n1.dot(n2));
}

HingePoints hinge_gradient(const HingePoints& x) {
  HingePoints gradient;
  gradient.fill(Vec3::Zero());
  const HingePoints none = gradient;
  const Vec3 hinge = x[1] - x[0];
  const double length = hinge.norm();
  if (length == 0) return none;
  const Vec3 u = hinge / length;
  for (std::size_t side : {0u, 4u}) {
    const Vec3 arm = 0.5 * ((x[side + 2] - x[0]) + (x[side + 3] - x[0]));
    const Vec3 across = u.cross(arm); // its length is the distance from the hinge line
    const double d2 = across.squaredNorm();
    if (!(d2 > 0)) return none;
    const Vec3 turn =
        (side == 0 ? -1.0 : 1.0) * across / d2; // θ falls as side one turns about u, side two makes it grow
    const double t = arm.dot(u) / length;
    gradient[side + 2] = gradient[side + 3] = 0.5 * turn;
    gradient[side] = -(1 - t) * turn;
    gradient[side + 1] = -t * turn;
  }
  return gradient;
}

HingePoints hinge_forces(const UnitParameters& p, const HingePoints& x, const HingePoints& v) {
  HingePoints forces = hinge_gradient(x);
  double rate = 0; // θ̇
  for (std::size_t n = 0; n < forces.size(); ++n) rate += forces[n].dot(v[n]);
  const double moment = p.k * wrapped(hinge_angle(x) - p.rest) + p.damping * rate;
  for (Vec3& force : forces) force *= -moment;
  return forces;
}

double hinge_energy(const UnitParameters& p, const HingePoints& x) {
  const double angle = wrapped(hinge_angle(x) - p.rest);
  return 0.5 * p.k * angle * angle;
}

} // namespace rend
