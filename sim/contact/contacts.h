// All contacts of a scene, at the end of each step, after every body has been advanced by itself:
//
//   detect       floor, spheres and boxes (obstacle_contact.h), bodies, mesh obstacles and fragments
//                (fragment_contact.h, edge_contact.h), the sides of cracks (torn_sides.h)
//   constraints  of one kind (contact_constraint.h)
//   answer       by impulses, all at once (contact_answer.h)
//   guard        what would go through each other nevertheless (crossing_guard.h)
//
// Within a step of velocity Verlet, and of other explicit schemes but symplectic Euler where something
// touches (sim/integrate/leapfrog.h).
//
// Prescribed vertices take no impulse: their supports do. Those of mesh obstacles are such: they are met as
// other bodies are.
#pragma once

#include "sim/contact/crossing_guard.h"
#include "sim/contact/edge_contact.h"
#include "sim/contact/fragment_contact.h"
#include "sim/contact/obstacle_contact.h"
#include "sim/contact/torn_sides.h"

#include <span>

namespace rend {

class Contacts {
public:
  // Null if no body has contacts: they then cost nothing. Called before bodies are prepared. UserError:
  // contact_names.h.
  static std::unique_ptr<Contacts> of(World& world, const std::vector<std::unique_ptr<Body>>& bodies,
                                      const Scheme& scheme);

  void advance(double time, double step); // [s]: changes the `next` of bodies and spheres
  // Of the step that was advanced: what is prescribed and goes through each other at its end; none: nothing.
  std::optional<ThroughEachOther> crossing() const;

  const std::vector<std::unique_ptr<ContactBody>>& bodies() const { return bodies_; }
  const FragmentContact* fragments() const { return fragments_.get(); } // null: not enabled in any body
  const TornSides* torn_sides() const { return torn_.get(); } // null: as there, or a scheme that solves
  const EdgeContact* edges() const { return edges_.get(); }   // null: edges of none can touch
  const EdgeContact* obstacle_edges() const { return obstacle_edges_.get(); } // null: none meets a mesh
  const CrossingGuard* guard() const { return guard_.get(); } // null: the floor alone, or a scheme that solves
  long searches() const;                                      // for pairs of any kind, so far
  bool with_faces() const; // some body can touch more than the floor, or there are spheres
  std::size_t bytes() const;
  void store(Archive& archive); // after the bodies: figures alone, since pairs are found anew

private:
  Contacts(World& world, const Scheme& scheme)
      : in_(scheme.contact), obstacles_(world), answer_(scheme.solves) {}
  void add_meshes(const World& world, std::size_t bodies);
  // The bodies among them, without mesh obstacles.
  std::span<const std::unique_ptr<ContactBody>> moving() const { return std::span(bodies_).first(moving_); }
  void detect();
  bool anything(); // that is to be answered
  ContactPairs* lists() { return fragments_ ? &fragments_->lists() : nullptr; }
  void drift_all(double time, double step);
  void end_step(double time, double step, bool drifted);

  ContactIn in_;
  // Those with contact, in the order of the scene, then the mesh obstacles that some of them meet.
  std::vector<std::unique_ptr<ContactBody>> bodies_;
  std::size_t moving_ = 0;                      // of them are bodies
  std::unique_ptr<FragmentContact> fragments_;  // null: not enabled in any body
  std::unique_ptr<CrossingGuard> guard_;        // null: as guard()
  std::unique_ptr<TornSides> torn_;             // null: no fragments, or a scheme that solves
  std::unique_ptr<EdgeContact> edges_;          // null: no two bodies can touch, and none itself
  std::unique_ptr<EdgeContact> obstacle_edges_; // null: none meets a mesh
  ObstacleContact obstacles_;
  ContactAnswer answer_;
};

} // namespace rend
