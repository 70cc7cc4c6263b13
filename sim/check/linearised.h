// A body as it answers to small motions about a state: M x'' = −K x − D x', prescribed coordinates held.
//
// K and D are those of the assembly (−∂f/∂x and −∂f/∂v), with the tangent that has no negative eigenvalue, so
// that what buckles by itself is not taken for a step that is too large; D holds damping between particles, and
// the rates of ambient viscosity and Rayleigh's mass part stand beside it. Wind is left out. It is a System: a
// time scheme steps it like any body, and since it is linear and homogeneous, a step is the product of the
// scheme's amplification matrix with the state, whatever the scheme.
#pragma once

#include "sim/scene/scene.h"
#include "sim/solve/spectrum.h"

#include <memory>

namespace rend {

class Linearised final : public System {
public:
  // About the present state of the body at `time` [s], which must outlive this.
  Linearised(const Body& body, double time);

  const BlockMatrix& stiffness() const { return stiffness_; }     // [N/m]
  const std::vector<std::uint8_t>& held() const { return held_; } // one per vertex slot
  HighestMode highest() const;                                    // of K and M
  double damping_rate(const Records& shape) const;                // φᵀ D φ + drag [1/s], φ of unit mass

  std::size_t vertices() const override { return held_.size(); }
  void forces(double time, const Record* position, const Record* velocity, Record* force) override;
  void constrain(double time, Record* position, Record* velocity) override;

private:
  BlockMatrix stiffness_, damping_; // damping_: empty where nothing damps between particles
  std::vector<std::uint8_t> held_;
  mutable Records product_; // scratch
};

} // namespace rend
