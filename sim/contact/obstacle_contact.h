// Contact of bodies with spheres and boxes, at the end of a step.
//
// Tested are the vertices, and the deepest point of each face, so that neither a small sphere nor the edge of a
// box slips between vertices. A point that is inside, or passed through, is kept out by a plane (obstacle.h):
// it is moved onto it, its normal velocity is set to 0, and Coulomb friction reduces its tangential velocity.
// With relative velocity u, plane normal n and inverse masses w of the point and W of the obstacle (0, unless
// it falls),
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
// Limits: several contacts of a heavy sphere are solved only as far as the iterations reach; obstacles respond
// to nothing else; a sphere much smaller than the faces should move less than its diameter in a step.
#pragma once

#include "sim/contact/contact_body.h"
#include "sim/outside/world.h"

#include <memory>

namespace rend {

class ObstacleContact {
public:
  explicit ObstacleContact(World& world) : world_(world) {}

  // Advances spheres to the end of the step (Sphere::next_*), and the bodies' `next` against all obstacles.
  void advance(const std::vector<std::unique_ptr<ContactBody>>& bodies, double time, double step);
  std::size_t bytes() const { return bytes_of(touches_) + bytes_of(codes_); }

private:
  struct Touch {
    std::size_t sphere;
    ContactPoint point;
    Vec3 normal; // from the sphere
    double friction;
    bool held; // it is constrained along the normal, or nearly
  };
  void exchange_momentum(const std::vector<std::unique_ptr<ContactBody>>& bodies, double step);
  void find_touches(std::size_t sphere, const ContactBody& body);
  void meet(Touch& touch, double step);
  void support(Sphere& sphere);
  void collide(Sphere& a, Sphere& b);
  void settle(Sphere& sphere, double step);

  World& world_;
  std::vector<Touch> touches_;      // scratch
  std::vector<std::uint8_t> codes_; // scratch, one per vertex slot: outside which sides of an obstacle it is
};

} // namespace rend
