#include "sim/mechanics/hinge_law.h"

#include "sim/base/math.h"

#include <algorithm>
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
  // From the hinge to the midpoint of each side's outer vertices: in the plane of the triangle (hinge, face
  // centre).
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
    const Vec3 across = u.cross(arm); // its length is the distance of P from the hinge line
    const double d2 = across.squaredNorm();
    if (!(d2 > 0)) return none;
    // θ decreases as side one rotates about u, and increases as side two does
    const Vec3 turn = (side == 0 ? -1.0 : 1.0) * across / d2;
    const double t = arm.dot(u) / length;
    gradient[side + 2] = gradient[side + 3] = 0.5 * turn;
    gradient[side] = -(1 - t) * turn;
    gradient[side + 1] = -t * turn;
  }
  return gradient;
}

namespace {

constexpr double crushed = 1.0 / 8; // of the area at rest

double square_of_side(const HingePoints& x, std::size_t side) { // |n|² [m⁴]
  const Vec3 arm = 0.5 * ((x[side + 2] - x[0]) + (x[side + 3] - x[0]));
  return (x[1] - x[0]).cross(arm).squaredNorm();
}

double fade_of(const HingeParameters& p, const HingePoints& x) { // φ₁ φ₂
  double fade = 1;
  for (std::size_t side : {0u, 4u})
    if (const double square = square_of_side(x, side); square < p.least) fade *= square / p.least;
  return fade;
}

double moment_of(const HingeParameters& p, const HingePoints& x, const HingePoints& v,
                 const HingePoints& gradient, double fade) {
  double rate = 0; // θ̇
  for (std::size_t n = 0; n < gradient.size(); ++n) rate += gradient[n].dot(v[n]);
  return fade * (p.k * wrapped(hinge_angle(x) - p.rest) + p.damping * (fade * rate));
}

} // namespace

double hinge_fade_threshold(const HingePoints& rest) {
  const double one = square_of_side(rest, 0), two = square_of_side(rest, 4), smaller = std::min(one, two);
  return crushed * crushed * (smaller > 0 ? smaller : std::max(one, two));
}

double hinge_moment(const HingeParameters& p, const HingePoints& x, const HingePoints& v) {
  return moment_of(p, x, v, hinge_gradient(x), fade_of(p, x));
}

HingePoints hinge_forces(const HingeParameters& p, const HingePoints& x, const HingePoints& v) {
  HingePoints forces = hinge_gradient(x);
  const double moment = moment_of(p, x, v, forces, fade_of(p, x));
  for (Vec3& force : forces) force *= -moment;
  return forces;
}

double hinge_energy(const HingeParameters& p, const HingePoints& x) {
  const double angle = wrapped(hinge_angle(x) - p.rest);
  return 0.5 * p.k * angle * angle * fade_of(p, x);
}

namespace {

HingePoints points_of(const Vec3* x) {
  HingePoints points;
  std::copy(x, x + points.size(), points.begin());
  return points;
}

class HingeLaw final : public ForceLaw {
public:
  HingeLaw() : ForceLaw("hinge", 8, 4, 1) {}

  void forces(const double* unit, const UnitState& s, Vec3* force) const override {
    const HingePoints f = hinge_forces(HingeParameters::of(unit), points_of(s.position), points_of(s.velocity));
    std::copy(f.begin(), f.end(), force);
  }

  double energy(const double* unit, const UnitState& s) const override {
    return hinge_energy(HingeParameters::of(unit), points_of(s.position));
  }

  // φ k g gᵀ and φ² λ g gᵀ with g = ∂θ/∂x, which are semi-definite; the exact tangent by position has also
  // −moment ∂²θ/∂x², by central differences of the force.
  void stiffness(const double* unit, const UnitState& s, Tangent tangent, UnitMatrix& by_position,
                 UnitMatrix& by_velocity) const override {
    const HingeParameters p = HingeParameters::of(unit);
    const HingePoints x = points_of(s.position), g = hinge_gradient(x);
    Eigen::Matrix<double, 24, 1> gradient;
    for (int n = 0; n < 8; ++n) gradient.segment<3>(3 * n) = g[static_cast<std::size_t>(n)];
    const double fade = fade_of(p, x);
    by_position = fade * p.k * gradient * gradient.transpose();
    by_velocity = fade * fade * p.damping * gradient * gradient.transpose();
    if (tangent != Tangent::Exact) return;
    const double h = 1e-6 * (x[1] - x[0]).norm();
    if (!(h > 0)) return;
    const HingePoints v = points_of(s.velocity);
    for (int column = 0; column < 24; ++column) {
      HingePoints ahead = x, behind = x;
      ahead[static_cast<std::size_t>(column / 3)][column % 3] += h;
      behind[static_cast<std::size_t>(column / 3)][column % 3] -= h;
      const HingePoints fa = hinge_forces(p, ahead, v), fb = hinge_forces(p, behind, v);
      for (int n = 0; n < 8; ++n)
        by_position.block<3, 1>(3 * n, column) =
            (fb[static_cast<std::size_t>(n)] - fa[static_cast<std::size_t>(n)]) / (2 * h);
    }
  }

  void bound(const double* unit, const Vec3* rest, const double*, double* stiffness,
             double* damping) const override { // Gershgorin discs of k g gᵀ: |g_n| Σ|g_m|
    const HingePoints g = hinge_gradient(points_of(rest));
    double sum = 0;
    for (const Vec3& v : g) sum += v.norm();
    for (std::size_t n = 0; n < g.size(); ++n) {
      stiffness[n] = unit[0] * g[n].norm() * sum;
      damping[n] = unit[1] * g[n].norm() * sum;
    }
  }

  bool acts(const double* unit, const std::uint32_t*) const override { return unit[0] != 0 || unit[1] != 0; }
};

} // namespace

const std::shared_ptr<const ForceLaw>& hinge_law() {
  static const std::shared_ptr<const ForceLaw> law = std::make_shared<HingeLaw>();
  return law;
}

} // namespace rend
