// A contact of a step: a point and what it must not come closer to, along a normal. Whatever is detected
// (obstacle_contact.h, fragment_contact.h, edge_contact.h, torn_sides.h) becomes one of these, and all of them
// are answered together (contact_answer.h).
#pragma once

#include "sim/contact/contact_body.h"
#include "sim/outside/obstacle.h"

namespace rend {

// One side of a contact: a point of a body, a sphere that falls, or an obstacle that moves as prescribed.
class ContactSide {
public:
  // `held`: contact does not move it along the normal (ContactPoint::held).
  static ContactSide of(const ContactPoint& point, bool held) { return {point, nullptr, Vec3::Zero(), held}; }
  static ContactSide of(Sphere& sphere) { return {{}, &sphere, Vec3::Zero(), false}; }
  // `velocity` [m/s]: of its surface there.
  static ContactSide of_obstacle(const Vec3& velocity) { return {{}, nullptr, velocity, true}; }

  // [m], at the end of the step; of an obstacle: the origin, so that planes in space are in the contact's
  // `apart`.
  Vec3 position() const;
  // [m/s], before the step, and of it.
  Vec3 velocity_before() const;
  Vec3 velocity() const;
  Vec3 inverse_mass() const; // [1/kg] along x, y, z
  const ContactPoint& point() const { return point_; }
  bool held() const { return held_; }
  // [J]: what moves it as prescribed does while it takes the impulse.
  double work_of_supports(const Vec3& impulse) const;
  Body* body() const { return point_.body ? point_.body->body : nullptr; } // null: an obstacle
  Sphere* sphere() const { return sphere_; }                               // null: none that falls

private:
  ContactSide(const ContactPoint& point, Sphere* sphere, const Vec3& surface, bool held)
      : point_(point), sphere_(sphere), surface_(surface), held_(held) {}
  ContactPoint point_; // its body null: an obstacle
  Sphere* sphere_;
  Vec3 surface_; // [m/s]
  bool held_;
};

struct ContactConstraint {
  ContactSide a, b;
  Vec3 normal;            // unit, from b to a
  double apart = 0;       // [m]: the gap is n·(x_a − x_b) − apart, and is not to be negative
  double kept = 0;        // [m], of that: the distance that is kept between surfaces
  double friction = 0;    // Coulomb's coefficient
  double restitution = 0; // Newton's coefficient, 0 to 1
  std::optional<std::size_t> obstacle =
      {}; // its number in the world; none: b is no obstacle that a body touches

  double gap() const { return normal.dot(a.position() - b.position()) - apart; } // [m], at the end of the step
};

// Of two bodies, or of a body and an obstacle, which becomes side b: they are to be `kept` [m] apart along
// `normal`, from b to a. With their friction and restitution.
ContactConstraint contact_between(const ContactPoint& a, const ContactPoint& b, const Vec3& normal,
                                  double kept);

} // namespace rend
