// The static solve, thesis 2.29: each step ends in equilibrium under the conditions prescribed at its end.
//
//   F(x) = f(x, 0) + M g + loads = 0       at the free coordinates; v' = 0, without viscosity
//
// 1. Newton's method with the exact tangent, symmetrised: K δ = F − K u, where u are the displacements of the
//    prescribed coordinates. A linear model is solved by the first iteration: K u = R. Follower loads add to
//    the tangent (load_tangent.h): K − L in place of K; after four iterations also what symmetrising left out.
// 2. If that fails, load steps: half of the increment of prescribed coordinates and forces, half of that ...:
//    F(x) = (1 − s) F(x_start), s from 0 to 1. Without line search: a slender beam must first be stretched by
//    the bending that a linear step predicts, and recovers from it in the next.
// 3. If no load step converges (a straight chain has no lateral stiffness, a cloth hardly any, a strut
//    buckles), relaxation: (K⁺ + σ M) δ = F with the semi-definite tangent, from a large σ to a small one as
//    long as the potential decreases along δ. That is implicit Euler with increasing steps and velocities
//    reset to 0 (pseudo-transient continuation, Kelley & Keyes 1998). Near the solution the exact tangent
//    replaces K⁺, with a σ of its own that makes it positive definite. First under the loads alone, then in
//    load steps of the prescribed displacements, finally under everything at once.
//
// Converged when |F| is at most 1e-9 of the sum of its terms, or round-off of positions in F. Far from the
// origin that could exceed all forces: it is limited to 1e-6 of them, or to its value within the range of
// positions of the step under the initial stiffness (a body without forces has no other scale). Newton's method
// must also find the tangent positive definite, or, if it is not symmetric, without negative eigenvalue
// (lowest_eigenvalue.h): a straight strut beyond its buckling load is not accepted. (Not tested with follower
// loads, as for a strip bent to a circle by a moment.) Relaxation decreases the potential, and stays at a
// saddle point only by symmetry. A component with a free translation is refused, and so is one with a free
// rotation in a linear model, whose f is not rotation invariant (rigid_motions.h). Once an equilibrium has been
// found, components that come off are no error: they take their rest shape in place, without loads.
#include "sim/base/stop_request.h"
#include "sim/integrate/lowest_eigenvalue.h"
#include "sim/integrate/newton_scheme.h"
#include "sim/integrate/rigid_motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rend {
namespace {

constexpr double static_digits = 1e-9, least_linear_digits = 1e-10, most_noise = 1e-6; // relative to the forces
constexpr double rounded = 4 * std::numeric_limits<double>::epsilon(); // relative to a coordinate
constexpr int most_symmetric = 4, most_newton = 16, most_falling = 60, most_relaxed = 600, most_solved = 3000;
constexpr double least_load_part = 1.0 / 256, least_unstable = 1.0 / 16; // load steps
// of a linear step, relative to the size of the body: beyond it the matrix counts as singular
constexpr double most_reach = 4096;
// σ relative to the mean stiffness
constexpr double first_sigma = 1e-3, least_sigma = 1e-12, near_digits = 1e-4;
constexpr double far_digits = 1e-2; // tolerance that is iterated in single precision
constexpr double near = 0.05;       // remaining share of the forces

enum class Found { Equilibrium, Unstable, Nothing, Singular };

class StaticSolve final : public NewtonScheme {
public:
  void advance(System& system, double time, double step, const StateView& now, const Record* force,
               State& next) override;
  std::size_t bytes() const override {
    std::size_t sum = bytes_of(supports_.held) + bytes_of(supports_.anchored) + bytes_of(supports_.detached) +
                      bytes_of(stiff_);
    for (const Records& one : supports_.room) sum += bytes_of(one);
    return sum + bytes_with({&position_, &trial_, &start_, &zeros_, &target_, &force_, &sum_, &first_sum_,
                             &imposed_, &right_, &update_});
  }
  bool has_inertia() const override { return false; }
  void keep_state(std::vector<double>& numbers) const override {
    NewtonScheme::keep_state(numbers);
    numbers.push_back(supports_.found_equilibrium);
    numbers.push_back(supports_.constrains_rotations);
  }
  bool restore_state(std::span<const double> numbers) override {
    if (!NewtonScheme::restore_state(numbers)) return false;
    supports_.found_equilibrium = numbers[saved_numbers] != 0;
    supports_.constrains_rotations = numbers[saved_numbers + 1] != 0;
    return true;
  }

private:
  void prepare(System& system, const StateView& now);
  bool solve(const StateView& now);
  void go_on_from(const Records& position);
  void evaluate(const Records& x);
  double noise(const Records& x) const;
  bool settled() const {
    return std::isfinite(norm_) && std::isfinite(terms_) && norm_ <= static_digits * terms_ + noise_;
  }
  void linearise(const Records& x, Tangent tangent);
  void set_right_side(double part);
  double digits(int n, double before) const;
  Found newton(double part);
  bool is_stable(bool whole);
  bool in_parts_of_the_way();
  bool loads_first();
  bool direction(Tangent tangent, double sigma, double part);
  bool relax(double part);
  bool without_rotations(const StateView& now);
  [[noreturn]] void give_up() const;

  System* system_ = nullptr;
  double end_ = 0; // [s]

  // One per vertex slot.
  Records position_, trial_, start_, zeros_; // [m]; zeros_: velocities of 0 [m/s]
  Records target_;                           // [m]: prescribed coordinates at the end of the step
  Records force_, sum_;                      // [N]: internal; F, 0 at prescribed coordinates
  Records first_sum_;                        // [N]: F at start_
  Records imposed_, right_, update_;         // [m], [N], [m]: u, the right-hand side, δ
  SupportState supports_;                    // constrained coordinates
  double norm_ = 0, terms_ = 0, noise_ = 0;  // [N]: of F, of its terms, and round-off
  std::vector<double> stiff_;                // [N/m]: the largest of each diagonal block; 0: not known yet
  double noise_of_start_ = -1;               // [N]: at most, within reach_ of the origin; < 0: not known yet
  double reach_ = 0;                         // [m]: the largest coordinate that this step has to do with
  double size_ = 0;                          // [m]: of the body; matrix_ [N/m]
  long last_ = 0;                            // what newton_ may come to in this step
};

double root_of_sum(Double4 v) {
  return std::sqrt(sum3(v));
}

void StaticSolve::prepare(System& system, const StateView& now) {
  system_ = &system;
  const std::size_t count = system.vertices();
  for (Records* each : {&trial_, &force_, &sum_, &imposed_, &right_, &update_}) each->resize(count);
  zeros_.assign(count, Record{});
  start_.assign(now.position, now.position + count);
  position_ = start_;
  size_ = extent(start_, system.inverse_mass);
  stiff_.assign(count, 0);
  noise_of_start_ = -1;
  hold(system, end_, supports_.held);
  target_ = start_;
  trial_ = zeros_;
  system.constrain(end_, target_.data(), trial_.data());
  reach_ = std::max({largest_coordinate(start_), largest_coordinate(target_), size_});
  supports_.check(system, end_, start_, zeros_, size_, matrix_);
}

// The round-off of F due to rounding positions at x, with the stiffness last assembled [N].
double StaticSolve::noise(const Records& x) const {
  Double4 sum{};
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Double4 moved = splat(stiff_[i]) * load(x[i]);
    sum += moved * moved;
  }
  return std::min(rounded * root_of_sum(sum), std::max(most_noise * terms_, noise_of_start_));
}

// F at x.
void StaticSolve::evaluate(const Records& x) {
  throw_if_stop_is_due();
  System& system = *system_;
  system.forces(end_, x.data(), zeros_.data(), force_.data());
  Double4 left{}, internal{}, outer{};
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double inverse = system.inverse_mass[i];
    const Double4 f = load(force_[i]);
    Double4 whole = f;
    if (inverse == 0)
      whole = Double4{};
    else if (!supports_.detached[i])
      whole = system.acceleration(i, f, Double4{}) * splat(1 / inverse);
    const Double4 free_part = free_axes(supports_.held[i]) * whole;
    store(sum_[i], free_part);
    left += free_part * free_part;
    internal += f * f;
    outer += (whole - f) * (whole - f);
  }
  norm_ = root_of_sum(left);
  terms_ = root_of_sum(internal) + root_of_sum(outer);
  noise_ = noise(x);
}

// Assembles the tangent at x without constraints, and the stiffness used by noise().
void StaticSolve::linearise(const Records& x, Tangent tangent) {
  matrix_.reset(system_->pattern());
  system_->add_stiffness(x.data(), zeros_.data(), tangent, 1, 0, matrix_);
  double squares = 0; // [N²/m²]
  for (std::size_t i = 0; i < x.size(); ++i) {
    stiff_[i] = stiffness_of(matrix_.diagonal(i));
    squares += stiff_[i] * stiff_[i];
    if (system_->inverse_mass[i] == 0) matrix_.add_diagonal(i, 1);
  }
  if (noise_of_start_ < 0) noise_of_start_ = rounded * reach_ * std::sqrt(squares);
}

// Computes the right-hand side F − K u of this load step; then constrains the matrix.
void StaticSolve::set_right_side(double part) {
  const Double4 rest = splat(1 - part);
  bool leads = false;
  load_tangent_.at(*system_, end_, trial_, zeros_, supports_.held, {});
  for (std::size_t i = 0; i < position_.size(); ++i) {
    const Double4 target = load(start_[i]) + splat(part) * (load(target_[i]) - load(start_[i]));
    const Double4 u = (Double4{1, 1, 1, 0} - free_axes(supports_.held[i])) * (target - load(trial_[i]));
    store(imposed_[i], u);
    leads = leads || u[0] != 0 || u[1] != 0 || u[2] != 0;
    store(right_[i], load(sum_[i]) - rest * load(first_sum_[i]));
  }
  if (leads) {
    matrix_.multiply(imposed_.data(), update_.data());
    for (std::size_t i = 0; i < position_.size(); ++i)
      store(right_[i], free_axes(supports_.held[i]) * (load(right_[i]) - load(update_[i])));
    if (load_tangent_.multiply(imposed_, update_)) add_scaled(1, 1, update_, right_);
  }
  matrix_.constrain(supports_.held.data());
  linear_.set_matrix(matrix_);
}

// The tolerance of iteration n for an iterative solver: no stricter than quadratic convergence can use.
double StaticSolve::digits(int n, double before) const {
  if (linear_.direct()) return least_linear_digits;
  const double fell = n == 0 ? 1 : norm_ / before;
  return std::clamp(std::max(0.5 * fell * fell, 0.3 * static_digits * terms_ / norm_), least_linear_digits,
                    far_digits);
}

// Whether the equilibrium at trial_ is stable, if that is tested.
bool StaticSolve::is_stable(bool whole) {
  if (linear_.factorise() == Definiteness::Positive || load_tangent_.counted()) return true;
  return whole && lowest_eigenvalue({*system_, end_, trial_, zeros_, supports_.held}, matrix_, linear_,
                                    load_tangent_) > 0;
}

// From position_ to the equilibrium of this load step; position_ is unchanged if there is none.
Found StaticSolve::newton(double part) {
  trial_ = position_;
  double before[2] = {}; // [N]: |F| of the last two iterations
  bool whole = false;    // include the part of the tangent that is not symmetric
  for (int n = 0; n <= most_falling; ++n) {
    evaluate(trial_);
    Double4 left{};
    for (std::size_t i = 0; i < trial_.size(); ++i) {
      const Double4 r = load(sum_[i]) - splat(1 - part) * load(first_sum_[i]);
      left += r * r;
    }
    norm_ = root_of_sum(left);
    if (!std::isfinite(norm_)) return Found::Nothing;
    if (n > 0 && settled()) {
      if (!is_stable(whole)) return Found::Unstable;
      position_ = trial_;
      return Found::Equilibrium;
    }
    if (n >= most_newton && norm_ > 0.5 * before[1]) break;
    linearise(trial_, Tangent::Exact);
    set_right_side(part);
    ++newton_;
    whole = whole || (n >= most_symmetric && norm_ > 0.1 * before[0]);
    if (whole) load_tangent_.with_forces(matrix_);
    if (!load_tangent_.solve(linear_, right_, update_, digits(n, before[0])))
      return n == 0 ? Found::Singular : Found::Nothing;
    if (n == 0 && largest_coordinate(update_) > most_reach * size_ * part) return Found::Singular;
    for (std::size_t i = 0; i < trial_.size(); ++i)
      store(trial_[i], load(trial_[i]) + load(update_[i]) + load(imposed_[i]));
    before[1] = std::exchange(before[0], norm_);
  }
  return Found::Nothing;
}

bool StaticSolve::in_parts_of_the_way() {
  double gone = 0, part = 1;
  while (gone < 1 && newton_ < last_) {
    const Found found = newton(gone + part);
    if (found == Found::Equilibrium) {
      gone += part;
      part = std::min(2 * part, 1 - gone);
      continue;
    }
    part *= 0.5;
    if (part < (found == Found::Unstable ? least_unstable : least_load_part)) return false;
    if (found == Found::Singular && gone == 0) return false;
  }
  return gone == 1;
}

// The update from position_ with the tangent shifted by σ [1/s²], into trial_; false: not a descent direction.
bool StaticSolve::direction(Tangent tangent, double sigma, double part) {
  linearise(position_, tangent);
  for (std::size_t i = 0; i < position_.size(); ++i)
    if (system_->inverse_mass[i] != 0) matrix_.add_diagonal(i, sigma / system_->inverse_mass[i]);
  trial_ = position_;
  set_right_side(part);
  ++newton_;
  if (!linear_.solve(right_, update_, norm_ > near * terms_ ? far_digits : near_digits)) return false;
  if (linear_.definiteness() != Definiteness::Positive) return false;
  for (std::size_t i = 0; i < trial_.size(); ++i)
    store(trial_[i], load(position_[i]) + load(update_[i]) + load(imposed_[i]));
  return true;
}

// Relaxes from position_ to an equilibrium with the prescribed coordinates of this load step, under all forces.
bool StaticSolve::relax(double part) {
  first_sum_.assign(position_.size(), Record{});
  evaluate(position_);
  linearise(position_, Tangent::SemiDefinite);
  const double mean = mean_stiffness(matrix_, system_->inverse_mass, position_.size());
  double far = first_sigma * mean,
         close = 1e-6 * mean; // σ of the semi-definite tangent, and of the exact one [1/s²]
  double tried = 0.1 * norm_; // [N]: residual at which Newton's method is tried
  bool helped = true;         // whether the last update reduced the residual
  for (int n = 0; n < most_relaxed && newton_ < last_; ++n) {
    const double before = norm_;
    if (n > 0 && settled()) return true;
    if (n > 0 && before < std::min(tried, 0.01 * terms_)) {
      if (newton(part) == Found::Equilibrium) return true;
      tried = 0.01 * before;
      evaluate(position_);
    }
    bool exact = n > 0 && norm_ < near * terms_ && close <= mean;
    if (exact && !direction(Tangent::Exact, close, part)) {
      close *= 10;
      exact = false;
    }
    if (!exact && !direction(Tangent::SemiDefinite, far, part)) return false;
    const double slope = dot(1, right_, update_);
    evaluate(trial_);
    const bool falls = n == 0 || slope + dot(1, sum_, update_) > 0 || norm_ < before; // by the trapezoidal rule
    double& sigma = exact ? close : far;
    const bool kept = std::isfinite(norm_) && falls;
    if (!kept)
      sigma *= exact ? 10 : 4;
    else if (helped)
      sigma = std::max(0.3 * sigma, least_sigma * mean);
    helped = kept;
    if (kept)
      position_.swap(trial_);
    else
      evaluate(position_);
  }
  return false;
}

// A body under tension follows prescribed displacements more easily: so first the loads, at the initial
// displacements.
bool StaticSolve::loads_first() {
  position_ = start_;
  if (!relax(0)) return false;
  start_ = position_;
  first_sum_.assign(start_.size(), Record{});
  return in_parts_of_the_way();
}

// A part that hangs by a hinge after tearing may have no equilibrium, if an average rotation leaves spurious
// moments: from then on it is treated as torn off.
bool StaticSolve::without_rotations(const StateView& now) {
  if (!supports_.found_equilibrium || supports_.constrains_rotations ||
      !can_rotate(*system_->pattern(), system_->inverse_mass, supports_.held, supports_.anchored,
                  start_.data()))
    return false;
  supports_.constrains_rotations = true;
  last_ += most_solved;
  prepare(*system_, now);
  evaluate(start_);
  first_sum_ = sum_;
  return in_parts_of_the_way() || loads_first() || relax(1);
}

void StaticSolve::give_up() const {
  const bool turns =
      can_rotate(*system_->pattern(), system_->inverse_mass, supports_.held, supports_.anchored, start_.data());
  const std::string left =
      fmt::format("no equilibrium was found: {:.2g} of the forces are left after {} iterations", norm_ / terms_,
                  newton_ - (last_ - most_solved));
  throw NotConverged(turns ? left + ", and the body can turn as a whole" : left,
                     turns ? "fix more than a point or a line"
                           : "let loads and drives grow over more steps, or use implicit with <viscosity>");
}

// From start_ to equilibrium under the contact forces as they are bounded now.
bool StaticSolve::solve(const StateView& now) {
  evaluate(start_);
  if (!std::isfinite(terms_))
    throw NotConverged("the forces overflow", "look for a mass, load or stiffness that is too large");
  first_sum_ = sum_;
  return in_parts_of_the_way() || loads_first() || relax(1) || without_rotations(now);
}

void StaticSolve::go_on_from(const Records& position) {
  start_ = position;
  last_ = newton_ + most_solved;
}

void StaticSolve::advance(System& system, double time, double step, const StateView& now, const Record* force,
                          State& next) {
  end_ = time + step;
  last_ = newton_ + most_solved;
  system.begin_solve(end_, step, now, force);
  prepare(system, now);
  if (!solve(now)) give_up();
  while (system.tighten_contact(position_.data())) {
    go_on_from(position_);
    if (!solve(now)) give_up();
  }
  system.constrain(end_, position_.data(), trial_.data()); // exact to the last bit
  for (std::size_t i = 0; i < position_.size(); ++i) next.put(i, load(position_[i]), Double4{});
  supports_.found_equilibrium = true;
}

} // namespace

Scheme static_solve() {
  return {.name = "static",
          .what = "no motion: each step is an equilibrium, by Newton's method",
          .order = 1,
          .evaluations = 2,
          .limit = &no_limit,
          .make = &make_integrator<StaticSolve>,
          .solves = true,
          .solves_contact = true,
          .contact = ContactIn::Result};
}

} // namespace rend
