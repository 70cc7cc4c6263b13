#include "sim/contact/contact_body.h"

#include <algorithm>
#include <limits>

namespace rend {

ContactBody::ContactBody(Body& body_, ContactIn in, std::size_t number_)
    : body(&body_), number(number_), in_(in) {
  if (settings().faces()) faces.emplace(*body_.map, body_.boundary());
}

void ContactBody::prepare(double time) {
  changed = faces && faces->update();
  of_start_ = in_ == ContactIn::Result || body->staggered;
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

Vec3 ContactPoint::velocity_before() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) sum += weight[k] * body->velocity_before(vertex[k]);
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

double ContactPoint::work_of_supports(const Vec3& impulse) const {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 w = body->inverse_mass(vertex[k]);
    for (int a = 0; a < 3; ++a)
      if (w[a] == 0) sum -= weight[k] * impulse[a] * body->velocity(vertex[k]).vec()[a];
  }
  return sum;
}

} // namespace rend
