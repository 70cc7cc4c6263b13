// No edge goes through a face: what contact leaves to be done after its answer, in steps of explicit schemes.
//
// An edge e and a face T that share no vertex cross if the ends of e lie on either side of T, and e meets T
// within it (edge_face.h). Of all pairs that <contact> asks for, but those of two fragments of one body, those
// that cross at the end of the step and did not at its start are kept apart:
//
//   1  by an impulse along the line between their nearest points at the start of the step,
//
//        n = (p − q)/|p − q|,   n·(p' − q') ≥ ½ |p − q|
//
//      for solids that touch there, |p − q| = 0, along the outward normal of T, n·(p' − q') ≥ 0 for the end
//      of e that is in the solid. It is one more contact in the answer, which is given anew: so it makes no
//      energy, and keeps momentum. Twice at most, since others may then be pushed together;
//   2  by moving the five vertices through the step as one rigid body, with all that are then pushed
//      together, until nothing more is (contact_zone.h).
//
// Likewise faces that come to overlap a box (obstacle_contact.h).
//
// Edges and faces that may cross are listed with those of contact_pairs.h. What crosses already is left alone:
// a start that overlaps is refused or pushed out (start_overlap.h). Torn sides of one body are not looked
// at here: they lie on each other when they part, on no side of each other (torn_sides.h).
//
// Two sides that are prescribed cross nevertheless: the run then stops before (Scene::stop_crossing). Where
// several things in a zone are prescribed, as boxes that pinch a cloth, the zone follows one of them, and may
// go through the others.
//
// What passes in one step would cross neither at its start nor at its end, if it is thinner than its way; it is
// stopped before that, along straight paths (fragment_contact.h), but for two that are both prescribed. The
// floor is not looked at again.
#pragma once

#include "sim/contact/contact_answer.h"
#include "sim/contact/contact_pairs.h"
#include "sim/contact/contact_zone.h"
#include "sim/contact/obstacle_contact.h"

#include <functional>
#include <map>
#include <span>
#include <vector>

namespace rend {

// Pairs of an edge and a face, or of a face and a box, in steps since this was made, rejected ones
// included.
struct CrossingFigures {
  long tried = 0;  // to be stopped by impulses, once for each round
  long joined = 0; // left by these, so moved as one
  long left = 0;   // that cross nevertheless: what is held or moved as prescribed leaves them no way out
};

// Two that go through each other, as prescribed.
struct ThroughEachOther {
  const Body* body = nullptr;
  const Body* other = nullptr;              // may be the same; null: an obstacle
  std::optional<std::size_t> obstacle = {}; // its number in the world
};

class CrossingGuard {
public:
  // Changes `next`, after the answer was given by solve(): gives it anew with more contacts, and accounts for
  // it. `step` [s]. `pairs`: null: no fragments.
  void keep_apart(const ContactBodies& bodies, ContactPairs* pairs, ObstacleContact& obstacles,
                  ContactAnswer& answer, double step);

  // Whether something would be kept apart where no contact is answered.
  bool comes_through(const ContactBodies& bodies, ContactPairs* pairs, ObstacleContact& obstacles,
                     ContactAnswer& answer);

  bool acted() const { return acted_; } // in the last step
  // The first of those that cross at its end nevertheless, by more than rounding may do, and are prescribed on
  // both sides; none: nothing does.
  std::optional<ThroughEachOther> prescribed(const ContactBodies& bodies,
                                             const ObstacleContact& obstacles) const;
  const CrossingFigures& figures() const { return figures_; }
  std::size_t bytes() const {
    return bytes_of(crossing_) + bytes_of(in_boxes_) + bytes_of(pushed_) + bytes_of(index_);
  }

private:
  struct Step; // what a step is about
  void number(const ContactBodies& bodies);
  bool find(const Step& of); // whether anything comes through
  void find_pairs(const Step& of);
  std::vector<ContactConstraint> constraints(const Step& of) const;
  struct Motion {
    std::function<Vec3(const Vec3&)> to; // where a point [m] at the start of the step goes
    bool led;                            // by what moves as prescribed
  };
  struct Change {
    Vec3 velocity = Vec3::Zero(); // [m/s]
    double work = 0;              // [J], of what leads the zone
  };
  bool unite(const Step& of);
  static Motion motion_of(const Step& of, std::span<const ZonePart> zone);
  void move_zones(const Step& of);
  long found() const { return static_cast<long>(crossing_.size() + in_boxes_.size()); }
  void account(const Step& of) const; // of zones

  std::vector<EdgeFacePair> crossing_; // now, sorted
  std::vector<BoxCrossing> in_boxes_;  // now
  std::vector<double> pushed_;         // [m], one per fragment: by the answer and by zones, at most
  ContactZones zones_;
  std::map<ZonePart, Change> changed_; // [m/s], in this step, of what is in zones: by them
  std::vector<std::uint32_t> index_;   // of a body, by its number in the scene
  bool acted_ = false;
  CrossingFigures figures_;
};

} // namespace rend
