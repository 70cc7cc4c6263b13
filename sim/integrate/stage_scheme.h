// What time schemes share whose steps are made of implicit stages. A stage finds the velocity v of each vertex,
// and with it the position x, from which
//
//   M (v − w) = q M a(x, v),    x = y + p v,    M a = f(x, v) + M g − γ v + loads
//
// where y, w and the lengths p, q > 0 [s] are the scheme's (implicit Euler: the old state, and the step).
//
// Solved by Newton's method from a first guess of v. With the residual
//
//   R(v) = q M a(x, v) − M (v − w),    ( M + q γ + q D + p q K ) δ = R,    v ← v + s δ
//
// where K = −∂f/∂x and D = −∂f/∂v are semi-definite tangents (force_law.h), so that the matrix is positive
// definite in every state, and δ is a descent direction of the potential whose gradient is −R. Line search: s
// is halved while |R| grows, unless R·δ at both ends of the update shows that the potential decreases. Norms
// are those of kinetic energy, |R|² = Σ |R_i|²/m_i. Converged when |R| is at most the scheme's tolerance times
// the sum of its terms, or round-off. Each linear system is solved to 1e-2. The matrix is reused as long as |R|
// falls below a share that the scheme says; secants of the last updates (secants.h) make that pay for longer. A
// step that has not converged after 50 iterations (buckling cloth, gusts of wind) is divided into two parts of
// half the size, these again ... down to 1/1024, below which it fails (NotConverged).
//
// Contact that the system takes into the solve (System::begin_solve) is part of f. When Newton's method has
// converged, its bounds are renewed, and it goes on from there until they stay.
//
// Loads that depend on the state (pressure, wind, follower loads) contribute p q ∂load/∂x + q ∂load/∂v to the
// tangent (load_tangent.h).
//
// Prescribed coordinates are where they will be from the start, and their rows and columns are those of the
// identity.
#pragma once

#include "sim/integrate/newton_scheme.h"
#include "sim/integrate/secants.h"

namespace rend {

// How a scheme wants its stages solved.
struct StageRules {
  double digits;        // of R, relative to the sum of its terms
  Tangent tangent;      // a semi-definite one
  double keeps_tangent; // the tangent is reused if |R| falls below this share
  bool secants;         // improve a tangent that is reused
};
// Of schemes of second order: errors of 1e-6 of the forces are below those of the steps that they are for.
constexpr StageRules second_order_rules{
    .digits = 1e-6, .tangent = Tangent::Projected, .keeps_tangent = 0.6, .secants = true};

class StageScheme : public NewtonScheme {
public:
  explicit StageScheme(const StageRules& rules) : rules_(rules) {}
  void advance(System& system, double time, double step, const StateView& now, const Record* force,
               State& next) override;
  std::size_t bytes() const override;

protected:
  // The step, or a part of it.
  struct Part {
    System& system;
    double start, size, end; // [s]
    StateView from;          // without accelerations
  };
  struct Stage {
    System& system;
    double end;                        // [s], when it ends
    double by_velocity, by_force;      // [s], p and q
    const Record *position, *velocity; // y [m] and w [m/s], one per vertex slot
  };

  // Solves a part; afterwards position_ and velocity_ are those at its end. NotConverged: nothing has changed
  // that a shorter part begins with.
  virtual void make_part(const Part& part) = 0;
  // Whether make_part() takes start_acceleration_.
  virtual bool begins_with_forces() const { return false; }

  // Solves a stage, from velocity_ as first guess, for position_ and velocity_.
  void solve(const Stage& stage);

  // One per vertex slot.
  Records position_, velocity_; // [m], [m/s]
  Records start_acceleration_;  // [m/s²], of the forces at the start of the part

private:
  // |R| and the sum of its terms, in the norm of kinetic energy [√J].
  struct Residual;
  Residual evaluate(const Stage& stage, const Records& v);
  void linearise(const Stage& stage);
  double round_off(const Stage& stage) const;
  bool search(const Stage& stage, Residual& residual);
  bool search_slope(const Stage& stage, Residual& residual);
  void converge(const Stage& stage, int& iterations);
  bool settled(const Stage& stage, const Residual& residual) const;
  void find_update(const Stage& stage, const Residual& residual);
  double linear_tolerance(const Residual& residual) const;
  void accept_part(const System& system);
  void accelerate(const System& system, const Record* force);
  void begin_forces(System& system, double start);

  StageRules rules_;
  Secants secants_;

  // One per vertex slot.
  Records trial_;                               // [m/s], v of the line search
  Records reached_position_, reached_velocity_; // [m], [m/s]: at the start of the part
  Records force_;                               // [N], internal, at the last trial v
  Records momentum_, before_;                   // [N·s], R there, and at velocity_
  Records update_;                              // [m/s], δ
  std::vector<std::uint8_t> held_;              // axes; matrix_ [kg]
};

} // namespace rend
