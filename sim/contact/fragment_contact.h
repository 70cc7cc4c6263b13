// Contact between bodies and between the fragments of one, at the end of a step: vertices against faces.
//
// For a vertex at x and the nearest point p = Σ b_i p_i of a face, both at the start of the step,
//
//   n = (x − p)/|x − p|,   gap = n·(x − p)
//   for a face of a solid, n is its outward normal if x projects onto it
//
// so that vertices stay on their side of a sheet, and no orientation is needed. If the gap at the end of the
// step would be less than the thickness, and less than it was, the pair takes an inelastic impulse with Coulomb
// friction,
//
//   J (impact.h) with inverse mass 1/m + Σ b_i²/m_i   on the vertex, −b_i J on those of the face
//
// and its positions are moved by inverse mass until the gap is what it was, at most the thickness. So momentum,
// angular momentum (but for the thickness) and the centre of mass are conserved to round-off, and kinetic
// energy only decreases.
//
// Fragments coincide exactly right after a separation. Only approaching motion is stopped: nothing that is
// closer than the thickness is pushed away, so there are no explosions, and separating motion is left alone, so
// nothing sticks. Coincident points of sheets have no side yet and pass until they have one. Penetrations
// (vertices below a solid's face, at most a fifth of its size deep) and gaps below the thickness that are not
// so at rest are resolved over `relaxation`, on positions only.
//
// Two bodies use the mean of their thicknesses and the larger friction. Limits: no edge-edge contacts (visible
// if cells are much larger than the thickness); several simultaneous contacts are solved only as far as
// `sweeps` iterations reach.
#pragma once

#include "sim/contact/contact_pairs.h"

namespace rend {

class FragmentContact {
public:
  void advance(const ContactPairs::Bodies& bodies, double step); // step [s]: changes the bodies' `next`
  std::size_t touching() const { return touches_.size(); }       // in the last step
  long searches() const { return pairs_.searches(); }
  std::size_t pairs() const { return pairs_.pairs(); } // candidates in the last step
  void store(Archive& archive, const ContactPairs::Bodies& bodies) { pairs_.store(archive, bodies); }
  std::size_t bytes() const { return pairs_.bytes() + bytes_of(touches_); }

private:
  struct Touch {
    ContactPoint vertex, face;
    Vec3 normal; // from the face to the vertex
    double gap;  // [m], required at the end of the step
    double friction;
    bool vertex_held, face_held; // ContactPoint::held
  };
  std::optional<Touch> touch(const ContactPairs::Bodies& bodies, const ContactPair& pair, double step) const;
  static void meet(const Touch& touch, double step);

  ContactPairs pairs_;
  std::vector<Touch> touches_; // scratch
};

} // namespace rend
