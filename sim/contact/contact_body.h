// A body as seen by contact in a step: its faces, and how impulses act on it.
//
// A point of a face, x = Σ b_i x_i with barycentric weights b_i, takes an impulse J as b_i J on each vertex,
// which preserves momentum and angular momentum. Its inverse mass is then Σ b_i²/m_i, along each axis: a vertex
// that is constrained along an axis has infinite mass along it, and its support takes the momentum.
#pragma once

#include "sim/body/body.h"
#include "sim/contact/contact_faces.h"
#include "sim/outside/impact.h"

namespace rend {

class ContactBody {
public:
  explicit ContactBody(Body& body_) : body(&body_), faces(*body_.map, body_.boundary()) {}

  // Called before the contacts of each step. `time` [s]: at the end of the step.
  void prepare(double time);

  Body* body;
  ContactFaces faces;
  bool changed = true; // whether the faces changed since the last step

  const ContactSettings& settings() const { return *body->contact; }
  std::size_t vertices() const { return body->vertices(); } // slots
  std::size_t bytes() const { return faces.bytes() + bytes_of(held_); }
  bool alive(Slot v) const { return body->inverse_mass[v] != 0; }
  // [1/kg] along x, y, z; 0: constrained, or free slot.
  Vec3 inverse_mass(Slot v) const {
    const double w = body->inverse_mass[v];
    if (held_.empty()) return Vec3::Constant(w);
    const unsigned axes = held_[v];
    return {axes & 1u ? 0 : w, axes & 2u ? 0 : w, axes & 4u ? 0 : w};
  }
  Vec3 from(Slot v) const { return body->map->position()[v]; } // [m], at the start of the step
  Record& position(Slot v) const { return body->next.position[v]; }
  Record& velocity(Slot v) const { return body->next.velocity[v]; }

private:
  std::vector<std::uint8_t> held_; // one per vertex slot, bits 0, 1, 2: prescribed along x, y, z; empty: none
};

// A point of a body: up to three of its vertices with barycentric weights.
struct ContactPoint {
  const ContactBody* body = nullptr;
  std::array<Slot, 3> vertex{}; // three times the same: a vertex
  std::array<double, 3> weight{};

  static ContactPoint at(const ContactBody& body, Slot v) { return {&body, {v, v, v}, {1, 0, 0}}; }

  Vec3 from() const;         // [m], at the start of the step
  Vec3 position() const;     // [m]
  Vec3 velocity() const;     // [m/s]
  Vec3 inverse_mass() const; // [1/kg] along x, y, z
  // The largest displacement of a vertex when the point is shifted by 1 along the normal: about 1, and more if
  // other vertices of the face, or axes in which the normal has a component, are constrained. Infinite if all
  // are.
  double leverage(const Vec3& normal) const;
  // Whether it is constrained along the normal, or so nearly that corrections would be too large.
  bool held(const Vec3& normal) const { return leverage(normal) > 4; }
  void apply_impulse(const Vec3& impulse,
                     double step) const; // [N·s]: changes velocities, and positions by step × that
  void displace(const Vec3& by) const;   // [kg·m]: changes positions only, each vertex by b_i/m_i of it
};

} // namespace rend
