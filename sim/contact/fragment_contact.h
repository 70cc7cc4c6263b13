// Detection of contact between bodies and between the fragments of one, at the end of a step: vertices
// against faces.
//
// For a vertex at x and the nearest point p = Σ b_i p_i of a face, both at the start of the step,
//
//   n = (x − p)/|x − p|,   gap = n·(x − p)
//   for a face of a solid, n is its outward normal if x projects onto it
//
// so that vertices stay on their side of a sheet, and no orientation is needed. There is a contact if the gap
// at the end of the step is less than the thickness; where vertex and face are neighbours, closer than that
// at rest, if it is less than at the start of the step. (Fragments coincide right after a separation.)
// Coincident points of sheets have no side yet and pass until they have one.
//
// Two bodies use the mean of their thicknesses, and the terms of contact_table.h. Limits: edges of fragments
// of one body have no contact with each other (visible if cells are much larger than the thickness; those of
// different bodies: edge_contact.h); what is deeper below a solid's face than a fifth of its size is not
// seen; what lies beyond a solid that is thinner than that is taken for being in it. Not so of obstacles,
// whose faces may be large: there a vertex counts as behind a face only where it is in the obstacle
// (ObstacleVertices::lies_behind).
#pragma once

#include "sim/contact/contact_answer.h"
#include "sim/contact/contact_pairs.h"

namespace rend {

class FragmentContact {
public:
  // `edges`: crossing_guard.h will ask for pairs of edges and faces.
  explicit FragmentContact(bool edges = false) : pairs_(edges) {}

  // Adds those of the bodies' `next` to the answer.
  void detect(const ContactPairs::Bodies& bodies, ContactAnswer& answer);
  long searches() const { return pairs_.searches(); }
  long sweeps() const { return pairs_.sweeps(); }
  std::size_t pairs() const { return pairs_.pairs(); } // candidates in the last step
  ContactPairs& lists() { return pairs_; }
  void forget() { pairs_.forget(); } // after a state was read: pairs are searched anew
  std::size_t bytes() const { return pairs_.bytes(); }

  // Of one pair, whether or not it was found; none: nothing touches in this step.
  static std::optional<ContactConstraint> touch(const ContactPairs::Bodies& bodies, const ContactPair& pair);

private:
  ContactPairs pairs_;
};

} // namespace rend
