// A body linearised about a state: M x'' = −K x − D x', with prescribed coordinates fixed.
//
// K and D are those of the assembly (−∂f/∂x and −∂f/∂v), with the semi-definite tangent, so that buckling is
// not mistaken for an unstable step; D contains the damping between particles, and the rates of ambient
// viscosity and mass-proportional Rayleigh damping are added. Wind is left out. It is a System: time schemes
// step it like any body, and since it is linear and homogeneous, a step is the product of the scheme's
// amplification matrix with the state, for every scheme.
#pragma once

#include "sim/scene/scene.h"
#include "sim/solve/spectrum.h"

#include <memory>

namespace rend {

class Linearised final : public System {
public:
  // About the current state of the body at `time` [s]. The body must outlive it.
  Linearised(const Body& body, double time);

  const BlockMatrix& stiffness() const { return stiffness_; }     // [N/m]
  const std::vector<std::uint8_t>& held() const { return held_; } // one per vertex slot
  HighestMode highest() const;                                    // of K and M
  double damping_rate(const Records& shape) const;                // φᵀ D φ + drag [1/s], φ of unit mass

  std::size_t vertices() const override { return held_.size(); }
  void forces(double time, const Record* position, const Record* velocity, Record* force) override;
  void constrain(double time, Record* position, Record* velocity) override;

private:
  BlockMatrix stiffness_, damping_; // damping_: empty if there is no damping between particles
  std::vector<std::uint8_t> held_;
  mutable Records product_; // scratch
};

} // namespace rend
