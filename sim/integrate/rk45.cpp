// The embedded pair of Dormand and Prince, of orders 5 and 4, with adaptive substeps (Hairer, Nørsett, Wanner,
// Solving Ordinary Differential Equations I, II.4 and II.5, table 5.2).
//
// With its coefficients a_ij (whose last row is the solution of order 5) and c_i = Σ_j a_ij, for x'' = a(x,
// x'):
//
//   v_i = v + h Σ_j a_ij a_j,    x_i = x + c_i h v + h² Σ_j ā_ij a_j,    ā = a·a,    a_i = a(x_i, v_i)
//
// which is the pair itself after substituting the stages' velocities: only accelerations are stored. The
// seventh stage is the new state, and its acceleration the first one of the next substep (first same as last).
// The very first stage uses the forces already evaluated for the fracture criteria. With e the difference of
// the weights of both solutions, the error estimate is
//
//   e_v = h Σ e_j a_j,    e_x = h² Σ_j (e·a)_j a_j,
//   error = √( Σ m (e_x² + (H e_v)²) / Σ m ) / (tolerance · size)
//
// over all vertices, each with its mass m; size is the body's. H is the step of the preset, at whose end
// fracture, contact and frames use the state: an error of velocity counts as the displacement that it causes
// until then. Prescribed coordinates have no acceleration of their own; where they start to move or are
// released, the vertices attached to them show the error.
//
// The step of the preset is divided into substeps, none longer than itself, the last one ending with it. A
// substep with an error above 1 is repeated with 0.9 error^(-1/5) of its size. After an accepted one the next
// size is multiplied by
//
//   0.9 (last error / error³)^(1/20)
//
// which also takes the growth of errors into account (II.4, "PI step size control"): stiff bodies keep substeps
// at the limit of stability, where otherwise every third would be rejected. Both factors are limited to between
// 1/5 and 5, and to 1 after a repeated substep. The size and the last error are passed on to the next step
// (saved_state). A substep below 2^-20 of the step fails (NotConverged).
#include "sim/base/stop_request.h"
#include "sim/integrate/integrator.h"
#include "sim/integrate/state_keeper.h"
#include "sim/solve/vectors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rend {
namespace {

constexpr int stages = 7;
using Weights = std::array<double, stages>;
using Table = std::array<Weights, stages>;

constexpr Table of_velocity{{{},
                             {1.0 / 5},
                             {3.0 / 40, 9.0 / 40},
                             {44.0 / 45, -56.0 / 15, 32.0 / 9},
                             {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                             {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                             {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}}};
constexpr Weights nodes{0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1};
constexpr Weights error_of_velocity{71.0 / 57600,      0,          -71.0 / 16695, 71.0 / 1920,
                                    -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

// From a row of weights of velocities to one of accelerations: the product with the table.
constexpr Weights twice(const Weights& row) {
  Weights out{};
  for (std::size_t k = 0; k < stages; ++k)
    for (std::size_t j = 0; j < stages; ++j) out[j] += row[k] * of_velocity[k][j];
  return out;
}
constexpr Table table_of_position() {
  Table out{};
  for (std::size_t i = 0; i < stages; ++i) out[i] = twice(of_velocity[i]);
  return out;
}
constexpr Table of_position = table_of_position();
constexpr Weights error_of_position = twice(error_of_velocity);

constexpr double shortest = 1.0 / (1 << 20); // relative to the step
constexpr double safety = 0.9, least_factor = 0.2, most_factor = 5, least_error = 1e-4;

// By Newton's method from above, in operations that give the same bits on every machine.
double fifth_root(double x) {
  double root = std::max(1.0, x);
  for (int n = 0; n < 100; ++n) {
    const double fourth = root * root * root * root, next = root - (root - x / fourth) / 5;
    if (!(next < root)) break;
    root = next;
  }
  return root;
}

// The factor of the size of the next substep, given this error and the last one.
double factor_for(double error, double last) {
  if (!(error <= 1)) // or NaN
    return error < 1e4 ? std::max(least_factor, safety / fifth_root(error)) : least_factor;
  const double e = std::max(error, least_error);
  return std::clamp(safety * std::sqrt(std::sqrt(fifth_root(last / (e * e * e)))), least_factor, most_factor);
}

using Stages = std::array<const Record*, stages>; // accelerations [m/s²], one per vertex slot

// Σ w_j a_j of a vertex over the first `count` stages, skipping zero weights.
template <int count> REND_INLINE Double4 sum_of(const Weights& weights, const Stages& a, std::size_t i) {
  Double4 sum{};
#pragma GCC unroll 7
  for (std::size_t j = 0; j < count; ++j)
    if (weights[j] != 0) sum += splat(weights[j]) * load(a[j][i]);
  return sum;
}

template <int stage>
REND_INLINE void go_to(std::size_t count, double h, const StateView& from, const Stages& a, State& to) {
  constexpr Weights of_v = of_velocity[stage], of_x = of_position[stage];
  const Double4 step = splat(h), square = splat(h * h), ahead = splat(h * nodes[stage]);
  for (std::size_t i = 0; i < count; ++i) {
    const Double4 v = load(from.velocity[i]);
    store(to.position[i], load(from.position[i]) + ahead * v + square * sum_of<stage>(of_x, a, i));
    store(to.velocity[i], v + step * sum_of<stage>(of_v, a, i));
  }
}
REND_INLINE void go_to_stage(int stage, std::size_t count, double h, const StateView& from, const Stages& a,
                             State& to) {
  switch (stage) {
  case 1:
    return go_to<1>(count, h, from, a, to);
  case 2:
    return go_to<2>(count, h, from, a, to);
  case 3:
    return go_to<3>(count, h, from, a, to);
  case 4:
    return go_to<4>(count, h, from, a, to);
  case 5:
    return go_to<5>(count, h, from, a, to);
  default:
    return go_to<6>(count, h, from, a, to);
  }
}

// From forces [N] to accelerations [m/s²], maybe in place; 0 along constrained axes.
REND_INLINE void accelerate(const System& system, std::size_t count, const Record* force,
                            const Record* velocity, const std::uint8_t* held, Record* out) {
  for (std::size_t i = 0; i < count; ++i) {
    const Double4 a = system.acceleration(i, load(force[i]), load(velocity[i]));
    store(out[i], held[i] ? a * free_axes(held[i]) : a);
  }
}

struct ErrorSums {
  Double4 position{}, velocity{}; // Σ m e_x² [kg m²], Σ m e_v² [kg m²/s²], per coordinate
  double mass = 0;                // [kg]
};
REND_INLINE void sum_errors(const double* inverse_mass, std::size_t count, double h, const Stages& a,
                            ErrorSums& sums) {
  const Double4 step = splat(h), square = splat(h * h);
  for (std::size_t i = 0; i < count; ++i) {
    if (inverse_mass[i] == 0) continue; // a free slot
    const double mass = 1 / inverse_mass[i];
    const Double4 x = square * sum_of<stages>(error_of_position, a, i);
    const Double4 v = step * sum_of<stages>(error_of_velocity, a, i);
    sums.position += splat(mass) * x * x;
    sums.velocity += splat(mass) * v * v;
    sums.mass += mass;
  }
}

class RungeKutta45 final : public Integrator, public StateKeeper {
public:
  explicit RungeKutta45(const SchemeSettings& settings) : settings_(settings) {}

  void advance(System& system, double time, double step, const StateView& now, const Record* force,
               State& next) override;
  SolverFigures solver() const override {
    SolverFigures figures;
    figures.substeps = substeps_;
    figures.rejected = rejected_;
    return figures;
  }
  std::size_t bytes() const override {
    std::size_t sum = reached_.bytes() + stage_.bytes() + bytes_of(held_);
    for (const Records& one : acceleration_) sum += bytes_of(one);
    return sum;
  }
  std::vector<double> saved_state() const override {
    std::vector<double> numbers;
    keep_state(numbers);
    return numbers;
  }
  void keep_state(std::vector<double>& numbers) const override {
    numbers = {next_size_, error_, static_cast<double>(substeps_), static_cast<double>(rejected_)};
  }
  bool restore_state(std::span<const double> numbers) override {
    const bool goes_on = numbers[0] > 0 && numbers[1] >= least_error && std::isfinite(numbers[1]);
    if (!goes_on || !is_whole_count(numbers[2]) || !is_whole_count(numbers[3])) return false;
    next_size_ = numbers[0];
    error_ = numbers[1];
    substeps_ = static_cast<long>(numbers[2]);
    rejected_ = static_cast<long>(numbers[3]);
    return true;
  }

private:
  struct Substep {
    double start, size, end; // [s]
    StateView from;
  };
  void derive(System& system, double time, const Record* force, const Record* velocity, std::size_t stage);
  void integrate_substep(System& system, const Substep& part);
  void make_substep(System& system, Substep& part, double left, double end, double step);
  double error_of(const System& system, const Substep& part, double step) const;
  Stages accelerations() const;

  SchemeSettings settings_;
  double next_size_ = std::numeric_limits<double>::infinity(); // [s], maximal size of the next substep
  double error_ = least_error;               // of the last accepted substep, relative to the tolerance
  State reached_, stage_;                    // at the start of a substep after the first, and within it
  std::array<Records, stages> acceleration_; // [m/s²], one per vertex slot
  std::vector<std::uint8_t> held_;           // constrained axes, one per vertex slot
  long substeps_ = 0, rejected_ = 0;
};

Stages RungeKutta45::accelerations() const {
  Stages out{};
  for (std::size_t j = 0; j < stages; ++j) out[j] = acceleration_[j].data();
  return out;
}

void RungeKutta45::derive(System& system, double time, const Record* force, const Record* velocity,
                          std::size_t stage) {
  std::fill(held_.begin(), held_.end(), std::uint8_t{0});
  system.mark_prescribed(time, held_.data());
  at_width<accelerate>(system, held_.size(), force, velocity, held_.data(), acceleration_[stage].data());
}

// Computes a substep into stage_, from the first acceleration.
void RungeKutta45::integrate_substep(System& system, const Substep& part) {
  for (std::size_t n = 1; n < stages; ++n) {
    const double time = nodes[n] == 1 ? part.end : part.start + nodes[n] * part.size;
    Record* force = acceleration_[n].data();
    at_width<go_to_stage>(static_cast<int>(n), system.vertices(), part.size, part.from, accelerations(),
                          stage_);
    system.constrain(time, stage_.position.data(), stage_.velocity.data());
    system.forces(time, stage_.position.data(), stage_.velocity.data(), force);
    derive(system, time, force, stage_.velocity.data(), n);
  }
}

double RungeKutta45::error_of(const System& system, const Substep& part, double step) const {
  ErrorSums sums;
  at_width<sum_errors>(system.inverse_mass, system.vertices(), part.size, accelerations(), sums);
  if (sums.mass == 0) return 0; // nothing is left of the body
  const double square = (sum3(sums.position) + step * step * sum3(sums.velocity)) / sums.mass;
  return std::sqrt(square) / (settings_.tolerance * settings_.size);
}

// Makes one substep, as long as next_size_ allows, repeated with smaller sizes until its error is small enough.
void RungeKutta45::make_substep(System& system, Substep& part, double left, double end, double step) {
  for (bool again = false;; again = true) {
    throw_if_stop_is_due();
    const bool last = next_size_ >= left;
    part.size = last ? left : std::min(next_size_, 0.5 * left); // avoids a tiny last substep
    part.end = last ? end : part.start + part.size;
    integrate_substep(system, part);
    const double error = error_of(system, part, step);
    const double proposed = part.size * std::min(factor_for(error, error_), again ? 1.0 : most_factor);
    if (error <= 1) { // a substep cut short by the end of the step says nothing about longer ones
      next_size_ = std::min(step, part.size < next_size_ ? std::max(next_size_, proposed) : proposed);
      error_ = std::max(error, least_error);
      ++substeps_;
      return;
    }
    ++rejected_;
    next_size_ = proposed;
    if (next_size_ < shortest * step)
      throw NotConverged(
          std::isfinite(error) ? "the error stays above the tolerance, even in parts of a millionth of the step"
                               : "forces are not finite",
          "use a shorter step, a larger tolerance, or, if the body is very stiff, integrator=\"implicit\"");
  }
}

void RungeKutta45::advance(System& system, double time, double step, const StateView& now, const Record* force,
                           State& next) {
  const std::size_t count = system.vertices();
  for (Records& each : acceleration_) each.resize(count);
  held_.resize(count);
  derive(system, time, force, now.velocity, 0);
  next_size_ = std::min(next_size_, step);
  Substep part{time, 0, 0, now};
  double gone = 0; // [s]
  while (gone < step) {
    stage_.resize(count);
    make_substep(system, part, step - gone, time + step, step);
    std::swap(reached_, stage_);
    std::swap(acceleration_.front(), acceleration_.back());
    gone = part.end == time + step ? step : gone + part.size;
    part.start = time + gone;
    part.from = {reached_.position.data(), reached_.velocity.data()};
  }
  for (std::size_t i = 0; i < count; ++i) next.put(i, load(reached_.position[i]), load(reached_.velocity[i]));
}

} // namespace

Scheme runge_kutta_45() {
  return {.name = "rk45",
          .what = "Dormand-Prince: each step is cut into parts, so that the error stays below tolerance",
          .order = 5,
          .evaluations = stages,
          .limit = &no_limit,
          .make = [](const SchemeSettings& settings) -> std::unique_ptr<Integrator> {
            return std::make_unique<RungeKutta45>(settings);
          },
          .adaptive = true,
          .contact = ContactIn::Step};
}

} // namespace rend
