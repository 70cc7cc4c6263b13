#include "sim/contact/contact_body.h"

#include <algorithm>
#include <limits>

namespace rend {

ContactBody::ContactBody(Body& body_, ContactIn in, std::size_t number_)
    : body(&body_), number(number_), in_(in), from_(&body_.map->position().values()),
      position_(&body_.next.position), velocity_(&body_.next.velocity) {
  if (settings().faces()) faces.emplace(*body_.map, body_.boundary());
}

ContactBody::ContactBody(const MeshObstacle& mesh, std::size_t obstacle_, std::size_t number_, double thickness)
    : obstacle(std::make_unique<ObstacleVertices>(mesh, obstacle_, thickness)), number(number_),
      from_(&obstacle->from), position_(&obstacle->position), velocity_(&obstacle->velocity) {
  faces.emplace(mesh.surface);
  changed = false;
}

const ContactTerms& ContactBody::terms(const ContactBody& other) const {
  CHECK(body);
  const auto& table = other.body ? body->contact_table.bodies : body->contact_table.obstacles;
  const std::size_t n = other.body ? other.number : other.obstacle->number;
  CHECK(n < table.size());
  return table[n];
}

bool ContactBody::meets(const ContactBody& other) const {
  if (!body) return other.body && other.meets(*this);
  const ContactSettings& its = other.settings();
  return (other.body ? settings().fragments && its.fragments : settings().obstacles) && !terms(other).excluded;
}

void ContactBody::prepare(double time, double step) {
  if (obstacle) return obstacle->move(time, step);
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
