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
// Limits: obstacles respond to nothing else; a sphere much smaller than the faces should move less than its
// diameter in a step.
#pragma once

#include "sim/contact/contact_answer.h"
#include "sim/outside/world.h"

#include <memory>

namespace rend {

class ObstacleContact {
public:
  explicit ObstacleContact(World& world);

  // Moves spheres to the end of the step as if nothing were in their way (Sphere::next_*). `time` [s]: at its
  // start.
  void predict(double time, double step);
  // Of what was predicted, for the bodies at the ends of their steps.
  void detect(const std::vector<std::unique_ptr<ContactBody>>& bodies, ContactAnswer& answer);
  std::size_t bytes() const { return bytes_of(codes_) + bytes_of(sphere_steps_) + bytes_of(box_steps_); }

private:
  const RigidStep* step_of(const Sphere& sphere) const; // null: it does not turn
  const RigidStep* step_of(const Box& box) const;       // null: it stands still
  void detect_floor(const ContactBody& body, ContactAnswer& answer) const;
  template <class Shape, class Side>
  void detect_shape(const Shape& shape, const ContactBody& body, std::size_t number, const Side& side,
                    ContactAnswer& answer);
  void detect_around(Sphere& sphere, ContactAnswer& answer);
  void detect_pair(Sphere& a, Sphere& b, ContactAnswer& answer);

  World& world_;
  std::vector<std::uint8_t> codes_; // scratch, one per vertex slot: outside which sides of an obstacle it is
  // of this step, one for each sphere and box; empty: no sphere turns, no box moves
  std::vector<RigidStep> sphere_steps_, box_steps_;
};

} // namespace rend
