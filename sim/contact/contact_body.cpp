#include "sim/contact/contact_body.h"

#include <algorithm>
#include <limits>

namespace rend {

void ContactBody::prepare(double time) {
  changed = faces.update();
  held_.clear();
  if (body->constraints.vertices().empty()) return;
  held_.assign(vertices(), 0);
  body->constraints.mark(time, held_.data());
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

Vec3 ContactPoint::inverse_mass() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) sum += weight[k] * weight[k] * body->inverse_mass(vertex[k]);
  return sum;
}

double ContactPoint::leverage(const Vec3& normal) const {
  const double whole = inverse_mass_along(normal, inverse_mass());
  double most = 0;
  for (std::size_t k = 0; k < 3; ++k)
    most = std::max(most, weight[k] * body->inverse_mass(vertex[k]).cwiseProduct(normal).norm());
  return whole > 0 ? most / whole : std::numeric_limits<double>::infinity();
}

void ContactPoint::apply_impulse(const Vec3& impulse, double step) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 change = weight[k] * body->inverse_mass(vertex[k]).cwiseProduct(impulse);
    Record &x = body->position(vertex[k]), &v = body->velocity(vertex[k]);
    x = Record(x.vec() + step * change);
    v = Record(v.vec() + change);
  }
}

void ContactPoint::displace(const Vec3& by) const {
  for (std::size_t k = 0; k < 3; ++k) {
    Record& x = body->position(vertex[k]);
    x = Record(x.vec() + weight[k] * body->inverse_mass(vertex[k]).cwiseProduct(by));
  }
}

} // namespace rend
