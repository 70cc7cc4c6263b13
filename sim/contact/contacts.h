// All contacts of a scene that are more than one body's with the floor (which is the body's own: contact.h), at
// the end of each step, after every body has made its own. Bodies and fragments among each other first, then
// obstacles, the floor last, and what is prescribed yields to none of them.
#pragma once

#include "sim/contact/fragment_contact.h"
#include "sim/contact/obstacle_contact.h"

namespace rend {

class Contacts {
public:
  // Null where no body asks for any: then it costs nothing. Before bodies are prepared.
  static std::unique_ptr<Contacts> of(World& world, const std::vector<std::unique_ptr<Body>>& bodies);

  void advance(double time, double step); // [s]: changes the `next` of bodies and spheres

  const std::vector<std::unique_ptr<ContactBody>>& bodies() const { return bodies_; }
  const FragmentContact* fragments() const { return fragments_.get(); } // null: no body asks for it
  std::size_t bytes() const;
  void store(Archive& archive); // after the bodies: what is near what, as it was last looked for

private:
  explicit Contacts(World& world) : obstacles_(world) {}
  std::vector<std::unique_ptr<ContactBody>> bodies_; // that ask for it, in the order of the scene
  std::unique_ptr<FragmentContact> fragments_;       // null: no body asks for it
  ObstacleContact obstacles_;
};

} // namespace rend
