// Implicit (backward) Euler (thesis 2.3.1, eq. 2.41): stable at any step, with numerical damping.
//
//   M (v' − v) = h ( f(x', v') + M g − γ v' + loads ),    x' = x + h v'
//
// Solved for v' by Newton's method from v' = v. With the residual
//
//   R(v') = h M a(x', v') − M (v' − v),    ( M + h γ + h D + h² K ) δ = R,    v' ← v' + s δ
//
// where K = −∂f/∂x and D = −∂f/∂v are the semi-definite tangents (force_law.h), so that the matrix is positive
// definite in every state, and δ is a descent direction of the potential whose gradient is −R. Line search: s
// is halved while |R| grows, unless R·δ at both ends of the update shows that the potential decreases. Norms
// are those of kinetic energy, |R|² = Σ |R_i|²/m_i. Converged when |R| is at most 1e-5 of the sum of its terms,
// or round-off; each linear system is solved to 1e-2, and the matrix is reused as long as |R| falls to a tenth.
// A step that has not converged after 50 iterations (buckling cloth, gusts of wind) is divided into two
// substeps of half the size, these again ... down to 1/1024, below which it fails (NotConverged).
//
// Loads that depend on the state (pressure, wind, follower loads) contribute h² ∂load/∂x + h ∂load/∂v to the
// tangent (load_tangent.h).
//
// Prescribed coordinates are where they will be from the start, and their rows and columns are those of the
// identity. Order 1. An undamped oscillator loses the factor 1/√(1 + ω²h²) a step.
#include "sim/integrate/newton_scheme.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {
namespace {

constexpr double newton_digits = 1e-5; // tolerance, relative to the terms of R
// tolerance of linear systems, relative to R: Newton's method with an approximate tangent gains little from
// more
constexpr double most_linear_digits = 1e-2;
constexpr double accepted = 1e-4;     // relative to the terms, if no update reduces R: the limit of round-off
constexpr double keeps_tangent = 0.1; // the tangent is reused if |R| falls below this share

constexpr int most_newton_iterations = 50, most_halvings = 12; // of Newton iterations, of the line search
constexpr int most_step_halvings = 10;                         // halvings of the step
constexpr double least_step_part = 1.0 / (1 << most_step_halvings);

// |R| and the sum of its terms, in the norm of kinetic energy [√J].
struct Residual {
  double norm = 0, terms = 0;
  bool finite() const { return std::isfinite(norm); }
};

class ImplicitEuler final : public NewtonScheme {
public:
  void advance(System& system, double time, double step, const StateView& now, const Record* force,
               State& next) override;
  std::size_t bytes() const override {
    return bytes_of(held_) + bytes_with({&position_, &velocity_, &trial_, &reached_position_,
                                         &reached_velocity_, &force_, &momentum_, &before_, &update_});
  }

private:
  struct Step {
    System& system;
    double end, size; // [s]
    const StateView& now;
  };
  Residual evaluate(const Step& step, const Records& v);
  void linearise(const Step& step);
  double round_off(const Step& step) const;
  bool search(const Step& step, Residual& residual);
  bool search_slope(const Step& step, Residual& residual);
  void converge(const Step& step, int& iterations);
  void solve(const Step& step);
  void accept_substep(const System& system);

  // One per vertex slot.
  Records position_, velocity_, trial_;         // [m], [m/s]: x', v', and a trial v' of the line search
  Records reached_position_, reached_velocity_; // [m], [m/s]: at the start of the substep
  Records force_;                               // [N], internal, at the last trial v'
  Records momentum_, before_;                   // [N·s], R there, and at velocity_
  Records update_;                              // [m/s], δ
  std::vector<std::uint8_t> held_;              // axes; matrix_ [kg]
};

// R at v', into momentum_; sets prescribed coordinates of v' and x'.
Residual ImplicitEuler::evaluate(const Step& step, const Records& v) {
  System& system = step.system;
  const std::size_t count = system.vertices();
  const Double4 h = splat(step.size);
  if (&v != &trial_) trial_ = v;
  for (std::size_t i = 0; i < count; ++i) store(position_[i], load(step.now.position[i]) + h * load(trial_[i]));
  system.constrain(step.end, position_.data(), trial_.data());
  system.forces(step.end, position_.data(), trial_.data(), force_.data());
  Double4 left{}, internal{}, outer{}, change{};
  for (std::size_t i = 0; i < count; ++i) {
    const double inverse = system.inverse_mass[i];
    if (inverse == 0) {
      momentum_[i] = Record{};
      continue;
    }
    const Double4 mass = splat(1 / inverse), open = free_axes(held_[i]), w = load(trial_[i]);
    const Double4 own = open * h * load(force_[i]) * splat(inverse); // [m/s], like the following terms
    const Double4 whole = open * h * system.acceleration(i, load(force_[i]), w);
    const Double4 gained = open * (w - load(step.now.velocity[i]));
    const Double4 rest = whole - gained;
    store(momentum_[i], mass * rest);
    left += mass * rest * rest;
    internal += mass * own * own;
    outer += mass * (whole - own) * (whole - own);
    change += mass * gained * gained;
  }
  return {std::sqrt(sum3(left)), std::sqrt(sum3(internal)) + std::sqrt(sum3(outer)) + std::sqrt(sum3(change))};
}

// Assembles the matrix at velocity_ and its position.
void ImplicitEuler::linearise(const Step& step) {
  System& system = step.system;
  const double h = step.size;
  matrix_.reset(system.pattern());
  system.add_stiffness(position_.data(), velocity_.data(), Tangent::SemiDefinite, h * h, h, matrix_);
  for (std::size_t i = 0; i < system.vertices(); ++i) {
    const double inverse = system.inverse_mass[i];
    const double rate = system.uniform_drag + (system.drag_rate ? system.drag_rate[i] : 0);
    matrix_.add_diagonal(i, inverse == 0 ? 1 : (1 + h * rate) / inverse);
  }
  matrix_.constrain(held_.data());
  linear_.set_matrix(matrix_);
}

// The part of R due to rounding of positions [√J].
double ImplicitEuler::round_off(const Step& step) const {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  Double4 sum{};
  for (std::size_t i = 0; i < position_.size(); ++i) {
    const Block3& d = matrix_.diagonal(i);
    const double stiff = std::max({d(0, 0), d(1, 1), d(2, 2)}) / step.size;
    const Double4 x = load(position_[i]);
    sum += splat(stiff * stiff * step.system.inverse_mass[i]) * x * x;
  }
  return 4 * epsilon * std::sqrt(sum3(sum));
}

// Line search along update_; false if it does not reduce the residual.
bool ImplicitEuler::search(const Step& step, Residual& residual) {
  const Residual start = residual;
  const double slope = dot(1, before_, update_);
  double share = 1;
  for (int n = 0; n < most_halvings; ++n, share *= 0.5) {
    trial_ = velocity_;
    add_scaled(1, share, update_, trial_);
    residual = evaluate(step, trial_);
    // the integral of R·δ by the trapezoidal rule
    const bool falls = residual.finite() && slope + dot(1, momentum_, update_) > 0.1 * slope;
    if (residual.finite() && (residual.norm < start.norm || falls)) {
      velocity_.swap(trial_);
      before_.swap(momentum_);
      return true;
    }
  }
  return false;
}

// The same where contact is solved, whose forces have kinks: R at both ends of an update says little of what is
// between. The potential has decreased where its slope −R·δ has fallen to half: found by bisection.
bool ImplicitEuler::search_slope(const Step& step, Residual& residual) {
  constexpr int most_bisections = 30;
  const double slope = dot(1, before_, update_);
  double low = 0, high = 1, share = 1;
  for (int n = 0; n < most_bisections; ++n, share = 0.5 * (low + high)) {
    trial_ = velocity_;
    add_scaled(1, share, update_, trial_);
    residual = evaluate(step, trial_);
    const double rest = dot(1, momentum_, update_);
    const bool finite = residual.finite();
    if (finite && rest > -0.5 * slope && (rest < 0.5 * slope || share == 1)) {
      velocity_.swap(trial_);
      before_.swap(momentum_);
      return true;
    }
    (finite && rest > 0 ? low : high) = share;
  }
  return false;
}

// The tolerance of the linear system: 1e-2, or less strict if that already reaches the final tolerance.
double linear_tolerance(const Residual& residual) {
  return std::clamp(0.3 * newton_digits * residual.terms / residual.norm, most_linear_digits, 0.1);
}

[[noreturn]] void give_up(const Residual& residual, int iterations) {
  throw NotConverged(
      residual.finite()
          ? fmt::format("Newton's method did not converge: {:.2g} of the forces are left after {} iterations",
                        residual.norm / residual.terms, iterations)
          : "forces are not finite",
      "use a smaller step");
}

// From velocity_ to the solution under the contact forces as they are bounded now.
void ImplicitEuler::converge(const Step& step, int& n) {
  Residual residual = evaluate(step, velocity_);
  velocity_.swap(trial_); // including prescribed values
  before_.swap(momentum_);
  bool linear = false, here = false; // linear: a matrix exists; here: it is the tangent at velocity_
  for (; residual.norm != 0; ++n) {
    if (n >= most_newton_iterations || !residual.finite()) give_up(residual, n);
    if (!linear) linearise(step);
    here = here || !linear;
    ++newton_;
    load_tangent_.at(step.system, step.end, position_, velocity_, held_, {step.size, 1, step.size});
    if (!load_tangent_.solve(linear_, before_, update_, linear_tolerance(residual)))
      throw NotConverged("the linear system of the step could not be solved", "use a smaller step");
    const Residual last = residual;
    const bool moved = step.system.in_contact() ? search_slope(step, residual) : search(step, residual);
    if (!moved) {
      residual = evaluate(step, velocity_);
      if (residual.norm <= accepted * residual.terms) return;
      if (here) give_up(residual, n);
    }
    if (residual.norm <= newton_digits * residual.terms + round_off(step)) return;
    linear = moved && residual.norm <= keeps_tangent * last.norm;
    here = false;
  }
}

void ImplicitEuler::solve(const Step& step) {
  int iterations = 0;
  do converge(step, iterations);
  while (step.system.tighten_contact(position_.data()));
}

// Accepts a substep: velocity_ and its position become the start of the next.
void ImplicitEuler::accept_substep(const System& system) {
  for (std::size_t i = 0; i < position_.size(); ++i) {
    if (system.inverse_mass[i] == 0) continue;
    reached_position_[i] = position_[i];
    reached_velocity_[i] = velocity_[i];
  }
}

void ImplicitEuler::advance(System& system, double time, double size, const StateView& now, const Record* force,
                            State& next) {
  const std::size_t count = system.vertices();
  for (Records* each : {&position_, &force_, &momentum_, &before_, &update_}) each->resize(count);
  reached_position_.assign(now.position, now.position + count);
  reached_velocity_.assign(now.velocity, now.velocity + count);
  double gone = 0, part = 1; // shares of the step; sums of powers of two, without rounding
  while (gone < 1) {
    const Step step{
        system, time + size * (gone + part), size * part, {reached_position_.data(), reached_velocity_.data()}};
    hold(system, step.end, held_);
    velocity_ = reached_velocity_;
    system.begin_solve(step.end, step.size, step.now, gone == 0 ? force : nullptr);
    try {
      solve(step);
    } catch (const NotConverged& unsolved) {
      part *= 0.5;
      if (part < least_step_part)
        throw NotConverged(
            fmt::format("{}, and after {} halvings of the step", unsolved.what(), most_step_halvings),
            unsolved.hint);
      continue;
    }
    accept_substep(system);
    gone += part;
    while (gone < 1 && std::fmod(gone, 2 * part) == 0) part *= 2;
  }
  for (std::size_t i = 0; i < count; ++i) next.put(i, load(reached_position_[i]), load(reached_velocity_[i]));
}

} // namespace

Scheme implicit_euler() {
  return {.name = "implicit",
          .what = "implicit Euler, by Newton's method: stable with every step; damps fast motion",
          .order = 1,
          .evaluations = 2,
          .limit = &no_limit,
          .make = &make_integrator<ImplicitEuler>,
          .solves = true};
}

} // namespace rend
