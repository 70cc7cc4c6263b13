// Contact of bodies with spheres and boxes, at the end of a step.
//
// Tested are the vertices, and the deepest point of each face, so that neither a small sphere nor the edge of a
// box slips between vertices. A point that is inside, or passed through, is kept out by a plane (obstacle.h):
// it is moved onto it, its normal velocity is set to 0, and Coulomb friction reduces its tangential velocity,
// both relative to the obstacle's surface there (RigidStep::velocity). With relative velocity u, plane normal n
// and inverse masses w of the point and W of the obstacle (0, unless it falls),
//
//   J = max(0, −u·n)/(w + W) n − min(1, μ max(0, −u·n)/|u_t|)/(w + W) u_t
//
// (impact.h handles partly constrained points.) J acts on the point, −J on the sphere: momentum is conserved to
// round-off, and kinetic energy decreases. Falling spheres first exchange momentum with all that they touch, in
// `sweeps` iterations in the order of bodies and slots, and then move with the resulting velocity; so do the
// points, and the remaining penetration is removed from positions only.
//
// A point that was inside at the start of the step, because a body starts around an obstacle or was released
// inside one, is moved out gradually (way_out() in impact.h). Only penetration that is new in the step is
// removed within it.
//
// Against a box that moves, points are taken back to where the preset puts it, from the start and from the end
// of the step: so the path is relative to the box. What moves obstacles works on bodies through contact
// (WorkMeter).
//
// Limits: several contacts of a heavy sphere are solved only as far as the iterations reach; obstacles respond
// to nothing else; a sphere much smaller than the faces should move less than its diameter in a step.
#pragma once

#include "sim/contact/contact_body.h"
#include "sim/outside/world.h"

#include <memory>

namespace rend {

class ObstacleContact {
public:
  explicit ObstacleContact(World& world);

  // Advances spheres to the end of the step (Sphere::next_*), and the bodies' `next` against all obstacles.
  void advance(const std::vector<std::unique_ptr<ContactBody>>& bodies, double time, double step);
  std::size_t bytes() const {
    return bytes_of(touches_) + bytes_of(codes_) + bytes_of(sphere_steps_) + bytes_of(box_steps_);
  }

private:
  struct Touch {
    std::size_t sphere;
    ContactPoint point;
    Vec3 normal; // from the sphere
    double friction;
    bool held; // it is constrained along the normal, or nearly
  };
  void predict(double time, double step);
  const RigidStep* step_of(const Sphere& sphere) const; // null: it does not turn
  const RigidStep* step_of(const Box& box) const;       // null: it stands still
  // Of its surface at x [m], at the end of the step.
  Vec3 velocity_at(const Sphere& sphere, const Vec3& x) const;
  // The plane that keeps a sphere's centre outside a box.
  std::optional<Plane> plane_against(const Box& box, const Sphere& sphere) const;
  void exchange_momentum(const std::vector<std::unique_ptr<ContactBody>>& bodies, double step);
  void find_touches(std::size_t sphere, const ContactBody& body);
  void meet(Touch& touch, double step);
  void support(Sphere& sphere);
  void collide(Sphere& a, Sphere& b);
  void settle(Sphere& sphere, double step);

  World& world_;
  std::vector<Touch> touches_;      // scratch
  std::vector<std::uint8_t> codes_; // scratch, one per vertex slot: outside which sides of an obstacle it is
  // of this step, one for each sphere and box; empty: no sphere turns, no box moves
  std::vector<RigidStep> sphere_steps_, box_steps_;
};

} // namespace rend
