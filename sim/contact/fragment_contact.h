// Contact between bodies and between the fragments of one, at the end of a step: vertices against faces.
//
// For a vertex at x and the nearest point p = Σ b_i p_i of a face, both at the start of the step,
//
//   n = (x − p)/|x − p|,   gap = n·(x − p)
//   of a solid's face, n is its outward normal where x is over or under it
//
// so that a sheet keeps on each side what was there, and nothing needs to know which side is which. Where the
// gap would be less than the thickness at the end of the step, and less than it was, the pair takes an
// inelastic impulse with Coulomb's friction,
//
//   J (impact.h) with yields 1/m + Σ b_i²/m_i   on the vertex, −b_i J on those of the face
//
// and its positions are moved by inverse mass until the gap is what it was, at most the thickness. So momentum,
// angular momentum but for the thickness, and the centre of mass are kept to round-off, and kinetic energy only
// falls.
//
// Fragments lie exactly on each other when they are parted. Only what approaches is stopped: nothing that is
// nearer than the thickness is pushed away, so nothing explodes, and what recedes is left alone, so nothing
// sticks. Two points of sheets that coincide have no side yet and pass until they have one. What overlaps
// (vertices below a solid's face, no deeper than a fifth of its size) and what came too near though it was not
// so at rest is worked off over `relaxation`, by positions alone.
//
// Of two bodies the mean of their thicknesses and the larger friction count. Limits: edges that cross in
// mid-air with no vertex near pass each other (cells show it if they are much larger than the thickness);
// several contacts at once are solved as far as `sweeps` rounds go.
#pragma once

#include "sim/contact/contact_pairs.h"

namespace rend {

class FragmentContact {
public:
  void advance(const ContactPairs::Bodies& bodies, double step); // step [s]: changes the bodies' `next`
  std::size_t touching() const { return touches_.size(); }       // in the last step
  long searches() const { return pairs_.searches(); }
  std::size_t pairs() const { return pairs_.pairs(); } // looked at in the last step
  void store(Archive& archive, const ContactPairs::Bodies& bodies) { pairs_.store(archive, bodies); }
  std::size_t bytes() const { return pairs_.bytes() + bytes_of(touches_); }

private:
  struct Touch {
    ContactPoint vertex, face;
    Vec3 normal; // from the face to the vertex
    double gap;  // [m], to be had at the end of the step
    double friction;
    bool vertex_held, face_held; // ContactPoint::held
  };
  std::optional<Touch> touch(const ContactPairs::Bodies& bodies, const ContactPair& pair, double step) const;
  static void meet(const Touch& touch, double step);

  ContactPairs pairs_;
  std::vector<Touch> touches_; // scratch
};

} // namespace rend
