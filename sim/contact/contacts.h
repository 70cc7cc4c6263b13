// All contacts of a scene other than with the floor (floor_contact.h, handled by the body), at the end of each
// step, after every body has been advanced. Order: bodies and fragments among each other, obstacles, the floor;
// prescribed vertices ignore all of them.
#pragma once

#include "sim/contact/fragment_contact.h"
#include "sim/contact/obstacle_contact.h"

namespace rend {

class Contacts {
public:
  // Null if no body has contacts: they then cost nothing. Called before bodies are prepared.
  static std::unique_ptr<Contacts> of(World& world, const std::vector<std::unique_ptr<Body>>& bodies);

  void advance(double time, double step); // [s]: changes the `next` of bodies and spheres

  const std::vector<std::unique_ptr<ContactBody>>& bodies() const { return bodies_; }
  const FragmentContact* fragments() const { return fragments_.get(); } // null: not enabled in any body
  std::size_t bytes() const;
  void store(Archive& archive); // after the bodies: the state of the pair search

private:
  explicit Contacts(World& world) : obstacles_(world) {}
  std::vector<std::unique_ptr<ContactBody>> bodies_; // those with contact, in the order of the scene
  std::unique_ptr<FragmentContact> fragments_;       // null: not enabled in any body
  ObstacleContact obstacles_;
  std::vector<TouchedVertex> touched_; // scratch: by the floor
};

} // namespace rend
