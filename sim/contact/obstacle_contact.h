// Detection of contacts with the floor, spheres and boxes, at the end of a step.
//
// Tested are the vertices, and the deepest point of each face, so that neither a small sphere nor the edge of a
// box slips between vertices. A point that is inside, or passed through, is kept out by a plane (obstacle.h);
// the velocity of the obstacle's surface is that of RigidStep::velocity there. Falling spheres are tested
// against the same obstacles, and against each other.
//
// Against a box that moves, points are taken back to where the preset puts it, from the start and from the end
// of the step: so the path is relative to the box.
//
// Meshes are met here by falling spheres alone (sphere_on_mesh.h), by bodies as other bodies are (contacts.h).
//
// Limits: obstacles respond to nothing else; a sphere much smaller than the faces should move less than its
// diameter in a step.
#pragma once

#include "sim/contact/contact_answer.h"
#include "sim/contact/contact_fragments.h"
#include "sim/contact/standing_mesh.h"
#include "sim/outside/world.h"

#include <memory>

namespace rend {

// A face that comes to overlap a box in a step.
struct BoxCrossing {
  std::uint32_t body = 0;     // index
  std::uint32_t triangle = 0; // index into the body's ContactFaces::triangles()
  std::uint32_t box = 0;      // index into the world's
  bool surely = false;        // twice as deep as rounding is taken to be
};

class ObstacleContact {
public:
  explicit ObstacleContact(World& world);

  // Moves spheres to the end of the step as if nothing were in their way (Sphere::next_*). `time` [s]: at its
  // start.
  void predict(double time, double step);
  // Of what was predicted, for the bodies at the ends of their steps.
  void detect(const ContactBodies& bodies, ContactAnswer& answer);

  bool near() const { return near_; } // whether a face was near one, when it was detected
  // For crossing_guard.h: faces that overlap a box at the ends of their steps, deeper than by rounding, and did
  // not at their starts.
  void find_crossing(const ContactBodies& bodies, std::vector<BoxCrossing>& found);
  // What keeps each of them out: its corners stay on the side of the plane on which they are at the start of
  // the step, at half of the distance.
  void keep_out(const ContactBodies& bodies, const BoxCrossing& crossing,
                std::vector<ContactConstraint>& wanted) const;
  std::size_t number_of(const BoxCrossing& crossing) const { return world_.number_of_box(crossing.box); }
  // [m], where a point of a box is at the end of the step that is at `from` [m] at its start.
  Vec3 carried(std::size_t box, const Vec3& from) const;
  std::size_t bytes() const;

private:
  const RigidStep* step_of(const Sphere& sphere) const; // null: it does not turn
  const RigidStep* step_of(const Box& box) const;       // null: it stands still
  void detect_floor(const ContactBody& body, ContactAnswer& answer) const;
  template <class Shape>
  void detect_shape(const Shape& shape, const ContactBody& body, std::size_t number, ContactAnswer& answer);
  ContactSide side_of(std::size_t number, const Vec3& surface) const;
  ContactConstraint constraint(const ContactPoint& point, const Plane& plane, std::size_t number,
                               const Vec3& surface, double kept, double restitution) const;
  template <class F> void each_shape(const ContactBody& body, const F& f) const;
  void find_crossing(const ContactBody& body, BoxCrossing one, std::vector<BoxCrossing>& found);
  RigidStep way_of(const Box& box) const; // that of a standing one as well
  void detect_around(Sphere& sphere, ContactAnswer& answer);
  template <class Add> void detect_on_meshes(const Sphere& sphere, const Add& add) const;
  void detect_pair(Sphere& a, Sphere& b, ContactAnswer& answer);

  World& world_;
  std::vector<std::uint8_t> codes_; // scratch, one per vertex slot: outside which sides of an obstacle it is
  bool near_ = false;
  // of this step, one for each sphere and box; empty: no sphere turns, no box moves
  std::vector<RigidStep> sphere_steps_, box_steps_;
  std::vector<StandingMesh> meshes_;  // one per mesh of the world; empty: no sphere falls
  std::vector<RigidStep> mesh_steps_; // one for each of them, of this step
};

} // namespace rend
