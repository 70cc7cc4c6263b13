// The largest stable step of each element by itself: which one limits the step of a scene, and what the step
// would be without the worst.
//
// The bounds of frequency.h are those of element corners; an element has the largest of its corners. A scheme's
// limit for these bounds is the element's step; the least of all is, but for damping, the step of the body.
#pragma once

#include "sim/body/body.h"
#include "sim/rows/frequency.h"

#include <string>

namespace rend {

class ElementSteps {
public:
  explicit ElementSteps(const Body& body); // which outlives this

  void update(); // after the masses of corners changed
  // Added to all rates of damping [1/s]: of wind, which is known once the body is prepared.
  void add_damping(double rate) { more_damping_ = rate; }

  // Slots of elements: from 0 to count(); free ones have no mass.
  std::size_t count() const { return bounds_.size(); }
  double mass(Slot element) const { return mass_[element]; } // [kg]
  // [s]; with masses `heavier` times as large.
  double step(const Scheme& scheme, Slot element, double heavier = 1) const;
  double least(const Scheme& scheme) const; // [s], of the whole body: scheme.limit() of frequency_bounds()
  double least_undamped(const Scheme& scheme) const; // [s], the same without damping and drag
  // [s], with other bounds of the body, to which the drag that all its vertices share is added.
  double step(const Scheme& scheme, const FrequencyBounds& bounds) const;

  // Such as "the tetrahedron 12 near (0, 0.1, 0.2) m".
  std::string name(Slot element) const;
  // Such as "dihedral angles from 0.4 to 179 degrees, aspect ratio 150".
  std::string shape(Slot element) const;
  double aspect(Slot element) const; // element_quality.h
  const Body& body() const { return *body_; }
  // Calls f(corner slot) for the corners of an element.
  template <class F> void for_each_corner(Slot element, F&& f) const {
    for (std::size_t n = first_[element]; n < first_[element + 1]; ++n) f(corners_[n]);
  }

private:
  const Body* body_;
  CellIndex elements_;
  std::vector<std::size_t> first_;      // one per element slot and one more: its first corner in corners_
  std::vector<Slot> corners_;           // of all elements, element by element
  std::vector<FrequencyBounds> bounds_; // one per element slot
  std::vector<double> mass_;            // [kg], one per element slot
  FrequencyBounds whole_;
  double more_damping_ = 0; // [1/s]
};

// Elements that make the step of a body shorter than others would: the worst hundredth, at least one.
struct FewElements {
  double gain = 0;   // how many times as long the step is without them; 0: they are all, or do not limit it
  std::string words; // on the worst one, and what is wrong with it: a sliver, too light, too stiff
};
FewElements few_that_limit(const ElementSteps& body, const Scheme& scheme, double limit); // limit [s]: its step

} // namespace rend
