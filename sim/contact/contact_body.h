// A body as seen by contact in a step: its faces, and how impulses act on it. A mesh obstacle is one, too,
// whose vertices are all prescribed (obstacle_vertices.h).
//
// A point of a face, x = Σ b_i x_i with barycentric weights b_i, takes an impulse J as b_i J on each vertex,
// which preserves momentum and angular momentum. Its inverse mass is then Σ b_i²/m_i, along each axis: a
// vertex that is constrained along an axis has infinite mass along it, and its support takes the momentum.
//
// An impulse J during a step of size h changes the velocity of a vertex by J/m, and its position by h J/m.
#pragma once

#include "sim/body/body.h"
#include "sim/contact/contact_faces.h"
#include "sim/contact/obstacle_vertices.h"

#include <optional>

namespace rend {

// n·K n: the inverse effective mass [1/kg] along n, with K = diag(inverse_masses).
inline double inverse_mass_along(const Vec3& normal, const Vec3& inverse_masses) {
  return normal.dot(inverse_masses.cwiseProduct(normal));
}

class ContactBody {
public:
  // `number_`: of the body in its scene.
  ContactBody(Body& body_, ContactIn in, std::size_t number_ = 0);
  // An obstacle: the one of this number in the world, and of `number_` behind all bodies of the scene;
  // `thickness` [m] of contact is that of the thickest body that meets it.
  ContactBody(const MeshObstacle& mesh, std::size_t obstacle_, std::size_t number_, double thickness);

  // Called before the contacts of each step, from `time` - `step` to `time` [s].
  void prepare(double time, double step);

  Body* body = nullptr;                       // null: an obstacle
  std::unique_ptr<ObstacleVertices> obstacle; // null: a body
  std::optional<ContactFaces> faces;          // none: it meets the floor alone
  bool changed = true;                        // whether the faces changed since the last step
  std::size_t number;
  bool meets_obstacles = false; // of meshes: its faces are looked at as with contact of fragments

  const ContactSettings& settings() const { return body ? *body->contact : obstacle->settings; }
  // Of a body: with another body, between fragments of it, or with an obstacle. CHECK: names are resolved
  // (contact_names.h).
  const ContactTerms& terms(const ContactBody& other) const;
  // Whether vertices and faces of the two are to be kept apart; with itself: those of two fragments.
  bool meets(const ContactBody& other) const;
  bool meets_faces() const { return !body || meets_obstacles || settings().fragments; } // of anything
  bool fixed() const { return obstacle && obstacle->fixed(); }                          // never moves
  std::size_t vertices() const { return body ? body->vertices() : from_->size(); }      // slots
  bool solid() const { return body ? body->map->dimension() == 3 : obstacle->closed(); }
  std::string called() const { return body ? body->name : obstacle->name; }
  std::size_t bytes() const {
    return (faces ? faces->bytes() : 0) + bytes_of(held_) + (obstacle ? obstacle->bytes() : 0);
  }
  bool alive(Slot v) const { return body && body->inverse_mass[v] != 0; }
  // [1/kg] along x, y, z; 0: constrained, free slot, or of an obstacle.
  Vec3 inverse_mass(Slot v) const {
    const double w = body ? body->inverse_mass[v] : 0;
    if (held_.empty()) return Vec3::Constant(w);
    const unsigned axes = held_[v];
    return {axes & 1u ? 0 : w, axes & 2u ? 0 : w, axes & 4u ? 0 : w};
  }
  Vec3 from(Slot v) const { return (*from_)[v]; } // [m], at the start of the step
  // [m/s], u⁻ of leapfrog.h; `by_contact` [m/s]: by what contact has changed the velocity in this step.
  Vec3 velocity_before(Slot v, const Vec3& by_contact = Vec3::Zero()) const {
    if (!body) return velocity(v);
    const Vec3 start = body->map->velocity()[v];
    return of_start_ ? start : Vec3(2 * start - (velocity(v).vec() - by_contact));
  }
  // At the end of the step; in one that drifts, the velocity is that of its middle.
  Record& position(Slot v) const { return (*position_)[v]; }
  Record& velocity(Slot v) const { return (*velocity_)[v]; }

private:
  ContactIn in_ = ContactIn::Step;
  // One per vertex slot: [m], [m/s].
  const std::vector<Record>* from_;
  std::vector<Record>*position_, *velocity_;
  bool of_start_ = true;           // u⁻ is the velocity at the start of the step
  std::vector<std::uint8_t> held_; // one per vertex slot, bits 0, 1, 2: prescribed along x, y, z; empty: none
};

// A point of a body: up to three of its vertices with barycentric weights.
struct ContactPoint {
  const ContactBody* body = nullptr;
  std::array<Slot, 3> vertex{}; // three times the same: a vertex
  std::array<double, 3> weight{};

  static ContactPoint at(const ContactBody& body, Slot v) { return {&body, {v, v, v}, {1, 0, 0}}; }

  // As those of ContactBody, before an impulse has changed the velocity.
  Vec3 from() const;
  Vec3 velocity_before() const;
  Vec3 position() const;
  Vec3 velocity() const;
  Vec3 inverse_mass() const; // [1/kg] along x, y, z
  // The largest displacement of a vertex when the point is shifted by 1 along the normal: about 1, and more
  // if other vertices of the face, or axes in which the normal has a component, are constrained. Infinite if
  // all are.
  double leverage(const Vec3& normal) const;
  // Whether it is constrained along the normal, or so nearly that corrections would be too large.
  bool held(const Vec3& normal) const { return leverage(normal) > 4; }
  // [J]: what the supports of its prescribed vertices do while it takes the impulse
  double work_of_supports(const Vec3& impulse) const;
};

} // namespace rend
