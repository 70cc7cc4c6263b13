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

} // namespace rend
