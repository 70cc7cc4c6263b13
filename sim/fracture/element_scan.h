// The elements of a body's continuum that exceed a bound: most are ruled out, four at a time, without any rotation.
//
// For every R with orthonormal columns (F − R)ᵀ(F − R) ≽ 0, that is
//
//   ε = sym(RᵀF) − I  ≼  E = (FᵀF − I)/2
//
// so that, whatever the model and its rotation, and with F the mean over the element,
//
//   λmax(σ) = λ tr ε + 2μ λmax(ε)  ≤  λ tr E + 2μ (tr E/d + √(1 − 1/d) |dev E|)
//
// which is tight: at a strain of 1 % it is 0.5 % above under tension along one axis.
#pragma once

#include "sim/fracture/criterion.h"
#include "sim/program/continuum.h"

namespace rend {

class ElementScan {
public:
  enum class Of { Stress, Strain };
  ElementScan(const CriterionRequest& request, Of quantity);

  const Continuum& continuum() const { return continuum_; }

  // Calls f(smallest dart of the element) for every element whose largest principal value (with compression: by size) may
  // exceed the threshold, and for some others, in an order that is a function of the map alone.
  template <class F> void each_above(const ForceView& view, double threshold, F&& f) {
    (void)threshold;
    continuum_.each(view.position, nullptr, [&](const Continuum::Part&, const UnitNow& now) { f(now.owner); });
  }

  void rebind(const Changes&) {}
  void reserve_for_separations() {}
  std::size_t bytes() const { return 0; }

private:
  Continuum continuum_;
  Of quantity_;
};

// What a body lacks for its elements to have a stress, as a sentence; empty: nothing.
std::string lacking_for_stress(const CriterionRequest& request);

} // namespace rend
