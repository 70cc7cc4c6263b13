#include "sim/check/step_limit.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rend {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-12; // of a radius of 1
constexpr int most_products = 60, halvings = 40;
constexpr double digits = 2e-4;    // to which the limit of a whole body is found
constexpr double converged = 1e-4; // of an eigenvalue

class Oscillator final : public System {
public:
  Oscillator(double omega_squared, double rate) : omega_squared_(omega_squared) {
    inverse_mass = &mass_;
    uniform_drag = rate;
  }
  std::size_t vertices() const override { return 1; }
  void forces(double, const Record* position, const Record*, Record* force) override {
    *force = Record(-omega_squared_ * position->x, 0, 0);
  }
  void constrain(double, Record*, Record*) override {}

private:
  double omega_squared_, mass_ = 1;
};

// The state after one step; one record per vertex.
void take_step(Integrator& integrator, System& system, double step, const State& from, Records& force,
               State& to) {
  system.forces(0, from.position.data(), from.velocity.data(), force.data());
  integrator.advance(system, 0, step, {from.position.data(), from.velocity.data()}, force.data(), to);
}

double radius_of_mode(const Scheme& scheme, Oscillator& system, double omega, double step) {
  const auto integrator = scheme.make({});
  Records force(1);
  Eigen::Matrix2d matrix;
  for (int column = 0; column < 2; ++column) {
    State from, to;
    from.resize(1);
    to.resize(1);
    (column == 0 ? from.position : from.velocity)[0].x = column == 0 ? 1 / omega : 1;
    take_step(*integrator, system, step, from, force, to);
    matrix.col(column) << omega * to.position[0].x, to.velocity[0].x;
  }
  const double half_trace = matrix.trace() / 2, determinant = matrix.determinant();
  const double square = half_trace * half_trace - determinant;
  return square < 0 ? std::sqrt(determinant) : std::abs(half_trace) + std::sqrt(square);
}

} // namespace

double step_limit_of_mode(const Scheme& scheme, double omega_squared, double damping_rate) {
  if (scheme.solves || (omega_squared <= 0 && damping_rate <= 0)) return infinite;
  const double speed = std::sqrt(std::max(omega_squared, 0.0)) + damping_rate, omega = std::sqrt(omega_squared);
  if (damping_rate <= 0 && scheme.limit({omega_squared, 0, 0}) <= 0)
    return 0; // it grows less than round-off shows
  Oscillator system(omega_squared, damping_rate);
  const auto stable = [&](double step) {
    return radius_of_mode(scheme, system, omega > 0 ? omega : 1, step) <= 1 + rounding;
  };
  double low = 1e-6 / speed, high = low;
  if (!stable(low)) return 0;
  while (stable(high)) { // the first step that is not: some schemes are stable again far out
    low = high;
    high *= 1.02;
    if (high * speed > 1e6) return infinite;
  }
  for (int n = 0; n < halvings; ++n) {
    const double middle = 0.5 * (low + high);
    (stable(middle) ? low : high) = middle;
  }
  return low;
}

namespace {

// The amplification matrix in (ω √m x, √m v), applied; both halves one per vertex slot.
class Amplification {
public:
  Amplification(const Scheme& scheme, Linearised& body, double omega, double step)
      : body_(&body), integrator_(scheme.make({})), omega_(omega), step_(step), force_(body.vertices()) {
    from_.resize(body.vertices());
    to_.resize(body.vertices());
    for (std::size_t i = 0; i < body.vertices(); ++i)
      root_.push_back(body.inverse_mass[i] > 0 ? 1 / std::sqrt(body.inverse_mass[i]) : 0);
  }

  void apply(const State& x, State& y) {
    scale(x, from_, true);
    take_step(*integrator_, *body_, step_, from_, force_, to_);
    scale(to_, y, false);
  }

private:
  void scale(const State& from, State& to, bool back) const {
    for (std::size_t i = 0; i < root_.size(); ++i) {
      const double r = back ? (root_[i] > 0 ? 1 / root_[i] : 0) : root_[i], w = back ? 1 / omega_ : omega_;
      store(to.position[i], splat(r * w) * load(from.position[i]));
      store(to.velocity[i], splat(r) * load(from.velocity[i]));
    }
  }

  Linearised* body_;
  std::unique_ptr<Integrator> integrator_;
  double omega_, step_;
  Records force_;
  State from_, to_;
  std::vector<double> root_; // √m, one per vertex slot
};

double product(const State& a, const State& b) {
  return dot(1, a.position, b.position) + dot(1, a.velocity, b.velocity);
}
void add(double s, const State& x, State& y) {
  add_scaled(1, s, x.position, y.position);
  add_scaled(1, s, x.velocity, y.velocity);
}

State start_of(const Linearised& body, const HighestMode& mode) {
  State start;
  start.position = scattered(body.vertices(), body.inverse_mass, body.held(), 3);
  start.velocity = scattered(body.vertices(), body.inverse_mass, body.held(), 4);
  const double weight = std::sqrt(product(start, start));
  for (std::size_t i = 0; i < body.vertices(); ++i) { // mostly the fastest mode
    const double mass = body.inverse_mass[i] > 0 ? 1 / body.inverse_mass[i] : 0;
    const Double4 part = splat(10 * weight * std::sqrt(mass)) * load(mode.shape[i]);
    store(start.position[i], load(start.position[i]) + part);
    store(start.velocity[i], load(start.velocity[i]) - splat(0.5) * part);
  }
  return start;
}

double largest_converged(const Eigen::MatrixXd& hessenberg, Eigen::Index size, double left) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(hessenberg.topLeftCorner(size, size));
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  double most = 0;
  for (Eigen::Index k = 0; k < size; ++k) {
    const auto vector = vectors.col(k);
    const double modulus = std::abs(solver.eigenvalues()[k]);
    const double residual = left * std::abs(vector[size - 1]) / vector.norm();
    if (residual <= converged * modulus) most = std::max(most, modulus);
  }
  return most;
}

} // namespace

double spectral_radius(const Scheme& scheme, Linearised& body, const HighestMode& mode, double step) {
  Amplification matrix(scheme, body, std::sqrt(mode.omega_squared), step);
  std::vector<State> basis{start_of(body, mode)};
  Eigen::MatrixXd hessenberg = Eigen::MatrixXd::Zero(most_products + 1, most_products);
  double norm = std::sqrt(product(basis[0], basis[0]));
  Eigen::Index size = 0;
  while (size < most_products && norm > 0) {
    State& last = basis.back();
    for (Records* half : {&last.position, &last.velocity})
      for (Record& r : *half) store(r, splat(1 / norm) * load(r));
    State next;
    next.resize(body.vertices());
    matrix.apply(last, next);
    const double before = std::sqrt(product(next, next));
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t k = 0; k < basis.size(); ++k) {
        const double along = product(basis[k], next);
        hessenberg(static_cast<Eigen::Index>(k), size) += along;
        add(-along, basis[k], next);
      }
    norm = std::sqrt(product(next, next));
    if (norm <= 1e-13 * before) norm = 0; // the space is closed
    hessenberg(size + 1, size) = norm;
    ++size;
    basis.push_back(std::move(next));
  }
  return largest_converged(hessenberg, size, norm);
}

StepLimit step_limit(const Scheme& scheme, Linearised& body) {
  const HighestMode mode = body.highest();
  StepLimit limit;
  limit.omega = std::sqrt(std::max(mode.omega_squared, 0.0));
  limit.damping_rate = body.damping_rate(mode.shape);
  limit.of_mode = limit.step = step_limit_of_mode(scheme, mode.omega_squared, limit.damping_rate);
  if (limit.of_mode == 0 || std::isinf(limit.of_mode)) return limit;
  const auto stable = [&](double step) { return spectral_radius(scheme, body, mode, step) <= 1 + 1e-9; };
  double low = limit.of_mode * (1 - digits), high = limit.of_mode * (1 + digits);
  if (stable(low) && !stable(high)) return limit; // the fastest mode rules
  if (stable(low))
    while (stable(high) && high < 8 * limit.of_mode) low = std::exchange(high, 1.1 * high);
  else
    while (!stable(low) && low > 1e-3 * limit.of_mode) high = std::exchange(low, 0.9 * low);
  while (high > (1 + digits) * low) {
    const double middle = 0.5 * (low + high);
    (stable(middle) ? low : high) = middle;
  }
  limit.step = low;
  return limit;
}

} // namespace rend
