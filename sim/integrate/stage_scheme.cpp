#include "sim/integrate/stage_scheme.h"

#include "sim/base/stop_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {
namespace {

// tolerance of linear systems, relative to R: Newton's method with an approximate tangent gains little from
// more
constexpr double most_linear_digits = 1e-2;
constexpr double accepted = 1e-4; // relative to the terms, if no update reduces R: the limit of round-off

constexpr int most_newton_iterations = 50, most_halvings = 12; // of Newton iterations, of the line search
constexpr int most_step_halvings = 10;                         // halvings of the step
constexpr double least_step_part = 1.0 / (1 << most_step_halvings);

} // namespace

struct StageScheme::Residual {
  double norm = 0, terms = 0;
  bool finite() const { return std::isfinite(norm); }
};

// R at v, into momentum_; sets prescribed coordinates of v and x.
StageScheme::Residual StageScheme::evaluate(const Stage& stage, const Records& v) {
  throw_if_stop_is_due();
  System& system = stage.system;
  const std::size_t count = system.vertices();
  const Double4 p = splat(stage.by_velocity), q = splat(stage.by_force);
  if (&v != &trial_) trial_ = v;
  for (std::size_t i = 0; i < count; ++i) store(position_[i], load(stage.position[i]) + p * load(trial_[i]));
  system.constrain(stage.end, position_.data(), trial_.data());
  system.forces(stage.end, position_.data(), trial_.data(), force_.data());
  Double4 left{}, internal{}, outer{}, change{};
  for (std::size_t i = 0; i < count; ++i) {
    const double inverse = system.inverse_mass[i];
    if (inverse == 0) {
      momentum_[i] = Record{};
      continue;
    }
    const Double4 mass = splat(1 / inverse), open = free_axes(held_[i]), w = load(trial_[i]);
    const Double4 own = open * q * load(force_[i]) * splat(inverse); // [m/s], like the following terms
    const Double4 whole = open * q * system.acceleration(i, load(force_[i]), w);
    const Double4 gained = open * (w - load(stage.velocity[i]));
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
void StageScheme::linearise(const Stage& stage) {
  System& system = stage.system;
  const double q = stage.by_force;
  matrix_.reset(system.pattern());
  system.add_stiffness(position_.data(), velocity_.data(), rules_.tangent, stage.by_velocity * q, q, matrix_);
  for (std::size_t i = 0; i < system.vertices(); ++i) {
    const double inverse = system.inverse_mass[i];
    const double rate = system.uniform_drag + (system.drag_rate ? system.drag_rate[i] : 0);
    matrix_.add_diagonal(i, inverse == 0 ? 1 : (1 + q * rate) / inverse);
  }
  matrix_.constrain(held_.data());
  linear_.set_matrix(matrix_);
  secants_.forget();
}

// The part of R due to rounding of positions [√J].
double StageScheme::round_off(const Stage& stage) const {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  Double4 sum{};
  for (std::size_t i = 0; i < position_.size(); ++i) {
    const Block3& d = matrix_.diagonal(i);
    const double stiff = std::max({d(0, 0), d(1, 1), d(2, 2)}) / stage.by_velocity;
    const Double4 x = load(position_[i]);
    sum += splat(stiff * stiff * stage.system.inverse_mass[i]) * x * x;
  }
  return 4 * epsilon * std::sqrt(sum3(sum));
}

bool StageScheme::settled(const Stage& stage, const Residual& residual) const {
  return residual.norm <= rules_.digits * residual.terms + round_off(stage);
}

// Line search along update_; false if it does not reduce the residual.
bool StageScheme::search(const Stage& stage, Residual& residual) {
  const Residual start = residual;
  const double slope = dot(1, before_, update_);
  double share = 1;
  for (int n = 0; n < most_halvings; ++n, share *= 0.5) {
    trial_ = velocity_;
    add_scaled(1, share, update_, trial_);
    residual = evaluate(stage, trial_);
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
bool StageScheme::search_slope(const Stage& stage, Residual& residual) {
  constexpr int most_bisections = 30;
  const double slope = dot(1, before_, update_);
  double low = 0, high = 1, share = 1;
  for (int n = 0; n < most_bisections; ++n, share = 0.5 * (low + high)) {
    trial_ = velocity_;
    add_scaled(1, share, update_, trial_);
    residual = evaluate(stage, trial_);
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
double StageScheme::linear_tolerance(const Residual& residual) const {
  return std::clamp(0.3 * rules_.digits * residual.terms / residual.norm, most_linear_digits, 0.1);
}

namespace {

[[noreturn]] void give_up(double left, int iterations) {
  throw NotConverged(
      std::isfinite(left)
          ? fmt::format("Newton's method did not converge: {:.2g} of the forces are left after {} iterations",
                        left, iterations)
          : "forces are not finite",
      "use a smaller step");
}

} // namespace

// Solves for update_, by the matrix and the secants that improve it.
void StageScheme::find_update(const Stage& stage, const Residual& residual) {
  ++newton_;
  load_tangent_.at(stage.system, stage.end, position_, velocity_, held_,
                   {stage.by_velocity, 1, stage.by_force});
  const Records& right = secants_.empty() ? before_ : secants_.right_side(before_);
  if (!load_tangent_.solve(linear_, right, update_, linear_tolerance(residual)))
    throw NotConverged("the linear system of the step could not be solved", "use a smaller step");
  secants_.complete(update_);
}

void StageScheme::solve(const Stage& stage) {
  hold(stage.system, stage.end, held_);
  int iterations = 0;
  do converge(stage, iterations);
  while (stage.system.tighten_contact(position_.data()));
}

// From velocity_ to the solution under the contact forces as they are bounded now.
void StageScheme::converge(const Stage& stage, int& n) {
  Residual residual = evaluate(stage, velocity_);
  velocity_.swap(trial_); // including prescribed values
  before_.swap(momentum_);
  bool linear = false, here = false; // linear: a matrix exists; here: it is the tangent at velocity_
  for (; residual.norm != 0; ++n) {
    if (n >= most_newton_iterations || !residual.finite()) give_up(residual.norm / residual.terms, n);
    if (!linear) linearise(stage);
    here = here || !linear;
    find_update(stage, residual);
    const Residual last = residual;
    const bool moved = stage.system.in_contact() ? search_slope(stage, residual) : search(stage, residual);
    if (!moved) {
      residual = evaluate(stage, velocity_);
      if (residual.norm <= accepted * residual.terms) return;
      if (here) give_up(residual.norm / residual.terms, n);
    }
    if (settled(stage, residual)) return;
    linear = moved && residual.norm <= rules_.keeps_tangent * last.norm;
    here = false;
    if (linear && rules_.secants) secants_.note(trial_, velocity_, momentum_, before_); // swapped by search()
  }
}

// Accepts a part: velocity_ and its position become the start of the next.
void StageScheme::accept_part(const System& system) {
  for (std::size_t i = 0; i < position_.size(); ++i) {
    if (system.inverse_mass[i] == 0) continue;
    reached_position_[i] = position_[i];
    reached_velocity_[i] = velocity_[i];
  }
}

// Sets start_acceleration_ from the internal forces at the start of a part, where the loads are evaluated too.
void StageScheme::accelerate(const System& system, const Record* force) {
  start_acceleration_.resize(system.vertices());
  for (std::size_t i = 0; i < system.vertices(); ++i)
    store(start_acceleration_[i], system.inverse_mass[i] == 0
                                      ? Double4{}
                                      : system.acceleration(i, load(force[i]), load(reached_velocity_[i])));
}

// Evaluates the forces at the start of a part, for a scheme that begins with them.
void StageScheme::begin_forces(System& system, double start) {
  if (!begins_with_forces()) return;
  system.forces(start, reached_position_.data(), reached_velocity_.data(), force_.data());
  accelerate(system, force_.data());
}

void StageScheme::advance(System& system, double time, double size, const StateView& now, const Record* force,
                          State& next) {
  const std::size_t count = system.vertices();
  for (Records* each : {&position_, &force_, &momentum_, &before_, &update_}) each->resize(count);
  reached_position_.assign(now.position, now.position + count);
  reached_velocity_.assign(now.velocity, now.velocity + count);
  if (rules_.secants) secants_.reserve(count);
  if (begins_with_forces()) accelerate(system, force);
  double gone = 0, part = 1; // shares of the step; sums of powers of two, without rounding
  while (gone < 1) {
    const StateView from{reached_position_.data(), reached_velocity_.data()};
    velocity_ = reached_velocity_;
    const double end = time + size * (gone + part);
    system.begin_solve(end, size * part, from, gone == 0 ? force : nullptr);
    try {
      make_part({system, time + size * gone, size * part, end, from});
    } catch (const NotConverged& unsolved) {
      part *= 0.5;
      if (part < least_step_part)
        throw NotConverged(
            fmt::format("{}, and after {} halvings of the step", unsolved.what(), most_step_halvings),
            unsolved.hint);
      begin_forces(system, time + size * gone); // those that were given may be what failed
      continue;
    }
    accept_part(system);
    gone += part;
    while (gone < 1 && std::fmod(gone, 2 * part) == 0) part *= 2;
    if (gone < 1) begin_forces(system, time + size * gone);
  }
  for (std::size_t i = 0; i < count; ++i) next.put(i, load(reached_position_[i]), load(reached_velocity_[i]));
}

std::size_t StageScheme::bytes() const {
  return bytes_of(held_) + secants_.bytes() +
         bytes_with({&position_, &velocity_, &start_acceleration_, &trial_, &reached_position_,
                     &reached_velocity_, &force_, &momentum_, &before_, &update_});
}

} // namespace rend
