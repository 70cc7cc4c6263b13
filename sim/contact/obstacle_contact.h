// Contact of bodies with spheres and boxes, at the end of a step.
//
// Looked at are the vertices, and of each face the point that lies deepest, so that neither a small sphere nor
// the edge of a box slips between vertices. A point that is inside, or passed through, is kept out by a plane
// (obstacle.h): it is put on it, loses its speed into it, and is slowed along it by Coulomb's friction. With
// relative velocity u, plane n and inverse masses w of the point and W of the obstacle (0, unless it falls),
//
//   J = max(0, −u·n)/(w + W) n − min(1, μ max(0, −u·n)/|u_t|)/(w + W) u_t
//
// (impact.h has it for what is held along some axes.)
// J on the point, −J on the sphere: momentum is conserved to round-off, and kinetic energy is lost by each.
// What falls first trades momentum with all that it touches, in `sweeps` rounds in the order of bodies and
// slots, and then moves with the velocity that this leaves; so do the points, and what overlap remains is taken
// off their positions alone.
//
// A point that was inside already at the start of the step, where a body starts around an obstacle or was let
// go within it, is moved out over `relaxation` and no faster than `fastest`: at once, it would be thrown out by
// the elastic forces of so large a deformation. Only what is new in the step is taken off in it.
//
// Limits: several contacts of a heavy sphere are solved as far as the rounds go; obstacles yield to nothing
// else; a sphere much smaller than the faces should move less than its diameter in a step.
#pragma once

#include "sim/contact/contact_body.h"
#include "sim/outside/world.h"

#include <memory>

namespace rend {

class ObstacleContact {
public:
  explicit ObstacleContact(World& world) : world_(world) {}

  // Spheres from the current state to the end of the step (Sphere::next_*), and what the bodies' `next` meets.
  void advance(const std::vector<std::unique_ptr<ContactBody>>& bodies, double time, double step);
  std::size_t bytes() const { return bytes_of(touches_) + bytes_of(codes_); }

private:
  struct Touch {
    std::size_t sphere;
    ContactPoint point;
    Vec3 normal; // from the sphere
    double friction;
    bool held; // it does not yield to the sphere, or hardly
  };
  void trade(const std::vector<std::unique_ptr<ContactBody>>& bodies, double step);
  void find_touches(std::size_t sphere, const ContactBody& body);
  void meet(Touch& touch, double step);
  void support(Sphere& sphere);
  void collide(Sphere& a, Sphere& b);
  void settle(Sphere& sphere, double step);

  World& world_;
  std::vector<Touch> touches_;      // scratch
  std::vector<std::uint8_t> codes_; // scratch, one per vertex slot: on which sides of an obstacle it is
};

} // namespace rend
