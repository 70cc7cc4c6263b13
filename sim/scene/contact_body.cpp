#include "sim/scene/contact_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {

void ContactBody::prepare(double time) {
  changed = faces.update();
  const std::vector<Slot>& prescribed = body->constraints.vertices();
  held_.clear();
  if (prescribed.empty()) return;
  constexpr std::uint8_t every_axis = 7;
  held_.assign(body->inverse_mass, body->inverse_mass + vertices());
  axes_.assign(vertices(), 0);
  body->constraints.mark(time, axes_.data());
  for (Slot v : prescribed)
    if (axes_[v] == every_axis) held_[v] = 0;
}

Vec3 ContactPoint::from() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) sum += weight[k] * body->from(vertex[k]);
  return sum;
}

Vec3 ContactPoint::position() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) sum += weight[k] * body->position(vertex[k]).vec();
  return sum;
}

Vec3 ContactPoint::velocity() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) sum += weight[k] * body->velocity(vertex[k]).vec();
  return sum;
}

double ContactPoint::inverse_mass() const {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += weight[k] * weight[k] * body->inverse_mass(vertex[k]);
  return sum;
}

double ContactPoint::leverage() const {
  const double whole = inverse_mass();
  double most = 0;
  for (std::size_t k = 0; k < 3; ++k) most = std::max(most, weight[k] * body->inverse_mass(vertex[k]));
  return whole > 0 ? most / whole : std::numeric_limits<double>::infinity();
}

void ContactPoint::push(const Vec3& impulse, double step) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 change = weight[k] * body->inverse_mass(vertex[k]) * impulse;
    Record &x = body->position(vertex[k]), &v = body->velocity(vertex[k]);
    x = Record(x.vec() + step * change);
    v = Record(v.vec() + change);
  }
}

void ContactPoint::shift(const Vec3& by) const {
  for (std::size_t k = 0; k < 3; ++k) {
    Record& x = body->position(vertex[k]);
    x = Record(x.vec() + weight[k] * body->inverse_mass(vertex[k]) * by);
  }
}

Vec3 impact(const Vec3& u, const Vec3& normal, double friction) {
  const double along = u.dot(normal), lost = std::max(0.0, -along);
  const Vec3 sliding = u - along * normal;
  const double speed = sliding.norm();
  const double stopped = speed > 0 ? std::min(1.0, friction * lost / speed) : 0;
  return lost * normal - stopped * sliding;
}

} // namespace rend
