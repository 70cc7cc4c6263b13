// Detection of contact between the two sides of a crack, at the end of a step: also within one fragment, where
// they still hang together at the tip of the crack. They are faces in a solid, and edges in a sheet.
//
// They lie on each other when the crack opens. Their distance is 0, and its direction does not tell on which
// side each of them is; vertices against faces (fragment_contact.h) know that only of different fragments of
// solids. So the sides are kept apart by a sign. Two sides were one if their corners lie at the same places at
// rest, and in solids if fracture has laid both bare; in sheets those of slits count as well. With the outward
// normals of both at the start of the step, m of the one and m' of the other, and corners x and x' there,
//
//   n = (m' − m)/|m' − m|,   gap = n·(x − x')
//
// is not to become negative, for each corner of which there are two by now. The outward normal of an edge lies
// in the plane of its face. All sides around a corner ask for this at once: what fits into a notch leaves it
// only where all its walls let it. In a solid a gap that has opened is kept up to the thickness, so that when
// the crack is through, its sides do not coincide any more. What overlaps is answered as any penetration
// (contact_answer.h), and parting is free.
//
// It is asked for where x and x' are still opposite each other: within half a side along it, and no deeper than
// that, with m·m' < 0; in sheets, no farther off their plane than a hundredth of the thickness. What has slid
// farther or come loose is for fragment_contact.h, and so are sheets one of which begins to cover the other:
// they have a side of each other by then. (With the whole thickness as that limit contact/drill has 155
// crossings, with a hundredth of it none.) Looked at anew in each step, so that nothing of it is stored.
//
// (Before this, most crossings began within a fragment: its sides had turned through each other about the
// vertices that they shared. Vertices against all faces around the joined one, signed likewise: half as many
// crossings as without, in fig-7.15, for 1.8 times the time; pairs of corners alone: a fifth, for no time that
// can be measured. Impulses for edges that come through a face, as between bodies (crossing_guard.h): as many
// crossings as before, for 5 times the time.)
//
// Limits: sides that have an edge or a vertex in common at rest, but were not one, are not opposite each other;
// nor is what a later cut has divided on one side alone, nor edges of a face that has a reflex angle there.
#pragma once

#include "sim/contact/contact_answer.h"
#include "sim/contact/contact_fragments.h"

#include <array>
#include <optional>
#include <vector>

namespace rend {

class TornSides {
public:
  // Adds those of the bodies' `next` to the answer.
  void detect(const ContactBodies& bodies, ContactAnswer& answer);
  void forget() { listed_ = false; } // after a state was read
  std::size_t pairs() const;         // of sides that were one and have two vertices at some corner by now
  std::size_t bytes() const;

private:
  using Corner = std::array<Slot, 2>; // vertices of the one side and of the other
  struct OfBody {
    std::vector<Corner> corners;      // of each pair of sides, around the first of them
    std::vector<std::uint32_t> begin; // of each pair, and the end
    std::vector<Corner> inside;       // of each pair of edges: a vertex of the face of each; of solids empty
  };
  class Pairing;
  void update(const ContactBodies& bodies); // lists those anew whose faces were changed
  static OfBody list(const ContactBody& body);

  std::vector<OfBody> of_; // one per body
  bool listed_ = false;
};

} // namespace rend
