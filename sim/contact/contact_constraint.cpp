#include "sim/contact/contact_constraint.h"

namespace rend {

Vec3 ContactSide::position() const {
  if (sphere_) return sphere_->next_centre;
  return point_.body ? point_.position() : Vec3(Vec3::Zero());
}

Vec3 ContactSide::velocity_before() const {
  if (sphere_) return sphere_->velocity;
  return point_.body ? point_.velocity_before() : surface_;
}

Vec3 ContactSide::velocity() const {
  if (sphere_) return sphere_->next_velocity;
  return point_.body ? point_.velocity() : surface_;
}

Vec3 ContactSide::inverse_mass() const {
  if (held_) return Vec3::Zero();
  return sphere_ ? Vec3(Vec3::Constant(sphere_->inverse_mass())) : point_.inverse_mass();
}

double ContactSide::work_of_supports(const Vec3& impulse) const {
  if (held_) return -impulse.dot(velocity());
  return sphere_ ? 0 : point_.work_of_supports(impulse);
}

ContactConstraint contact_between(const ContactPoint& a, const ContactPoint& b, const Vec3& normal,
                                  double kept) {
  if (!a.body->body) return contact_between(b, a, -normal, kept);
  const ContactTerms& terms = a.body->terms(*b.body);
  const bool obstacle = !b.body->body;
  const ContactSide other =
      obstacle ? ContactSide::of_obstacle(b.velocity()) : ContactSide::of(b, b.held(normal));
  return {.a = ContactSide::of(a, a.held(normal)),
          .b = other,
          .normal = normal,
          .apart = obstacle ? kept + normal.dot(b.position()) : kept,
          .kept = kept,
          .friction = terms.friction,
          .restitution = terms.restitution,
          .obstacle = obstacle ? std::optional(b.body->obstacle->number) : std::nullopt};
}

} // namespace rend
