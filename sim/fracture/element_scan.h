// Finds the continuum elements of a body that exceed a threshold: most are ruled out by a bound, four at a
// time, without computing a rotation.
//
// With F the volume average over the element, for every R with orthonormal columns (F − R)ᵀ(F − R) ≽ 0, that is
//
//   ε = sym(RᵀF) − I  ≼  E = (FᵀF − I)/2
//
// so that for every model and rotation,
//
//   λmax(σ) = λ tr ε + 2μ λmax(ε)  ≤  λ tr E + 2μ (tr E/d + √(1 − 1/d) |dev E|)
//
// which is tight: at a strain of 1 % it is 0.5 % too large under uniaxial tension. Under compression, with the
// closest rotation and det F > 0, RᵀF = √(2E + I) and c = 2/(1 + √(1 + 2m)), m ≤ λmin(E), give ε ≽ c E where E
// is negative and tr ε ≥ tr E − c²|E|²/2. Elements without a bound are evaluated.
#pragma once

#include "sim/fracture/continuum_rows.h"

namespace rend {

class ElementScan {
public:
  enum class Quantity { Stress, Strain };
  ElementScan(const CriterionRequest& request, Quantity quantity);

  const Continuum& continuum() const { return rows_.continuum(); }

  // Calls f(smallest dart of the element) for every element whose largest principal value (with compression: by
  // magnitude) may exceed the threshold, and for some others, in an order that is a function of the map alone.
  template <class F> void each_above(const ForceView& view, double threshold, F&& f) {
    for (std::size_t n = 0; n < rows_.parts().size(); ++n) {
      const Binder& binder = rows_.of(view, n);
      keys_.clear();
      scan(rows_.parts()[n], binder.rows(), view.position, threshold);
      for (std::size_t key : keys_) f(view.map.cells(binder.pattern().owner).first_dart(binder.owner_of(key)));
    }
  }

  void rebind(const Changes& changes) { rows_.rebind(changes); }
  void reserve_for_separations() { rows_.reserve_for_separations(); }
  std::size_t bytes() const { return rows_.bytes() + keys_.capacity() * sizeof(std::size_t); }

private:
  void scan(const Continuum::Part& part, const PackedRows& rows, const Record* position, double threshold);

  ContinuumRows rows_;
  Quantity quantity_;
  bool compression_;
  std::vector<std::size_t> keys_; // scratch: keys of rows that may exceed the threshold
};

// The criterion on elements: their largest principal value.
std::unique_ptr<Criterion> largest_of_elements(const CriterionRequest& request, ElementScan::Quantity quantity);

// Why the elements of a body have no stress, as a sentence; empty: they have.
std::string lacking_for_stress(const CriterionRequest& request);

} // namespace rend
