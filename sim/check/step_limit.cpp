#include "sim/check/step_limit.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

namespace rend {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-12; // tolerance of a spectral radius of 1
constexpr int most_products = 60, halvings = 40;
constexpr double digits = 2e-4; // relative accuracy of the limit of a whole body
constexpr double fast = 0.5;    // relative to the highest mode

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
    return 0; // it grows by less than round-off
  Oscillator system(omega_squared, damping_rate);
  const auto stable = [&](double step) {
    return radius_of_mode(scheme, system, omega > 0 ? omega : 1, step) <= 1 + rounding;
  };
  double low = 1e-6 / speed, high = low;
  if (!stable(low)) return 0;
  while (stable(high)) { // the first unstable step: some schemes are stable again at much larger ones
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

// Applies the amplification matrix in (ω √m x, √m v); both halves have one record per vertex slot.
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
    from_scaled(x, from_);
    take_step(*integrator_, *body_, step_, from_, force_, to_);
    to_scaled(to_, y);
  }

  // |√m a|²/ω², with the accelerations by stiffness and by damping taken separately: they may cancel.
  double acceleration(const State& x) {
    from_scaled(x, from_);
    const Records nothing(root_.size());
    return acceleration(from_.position, nothing) + acceleration(nothing, from_.velocity);
  }

private:
  double acceleration(const Records& position, const Records& velocity) {
    body_->forces(0, position.data(), velocity.data(), force_.data());
    double sum = 0;
    for (std::size_t i = 0; i < root_.size(); ++i) {
      const Double4 a = body_->acceleration(i, load(force_[i]), load(velocity[i]));
      sum += root_[i] * root_[i] * sum3(free_axes(body_->held()[i]) * a * a);
    }
    return sum / (omega_ * omega_);
  }
  // From (x, v) to (ω √m x, √m v), and back.
  void to_scaled(const State& from, State& to) const {
    for (std::size_t i = 0; i < root_.size(); ++i) scale(i, root_[i], omega_, from, to);
  }
  void from_scaled(const State& from, State& to) const {
    for (std::size_t i = 0; i < root_.size(); ++i)
      scale(i, root_[i] > 0 ? 1 / root_[i] : 0, 1 / omega_, from, to);
  }
  static void scale(std::size_t i, double r, double w, const State& from, State& to) {
    store(to.position[i], splat(r * w) * load(from.position[i]));
    store(to.velocity[i], splat(r) * load(from.velocity[i]));
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

// The highest mode, with a small component of everything.
State start_of(const Linearised& body, const HighestMode& mode) {
  State start;
  start.position = scattered(body.vertices(), body.inverse_mass, body.held(), 3);
  start.velocity = scattered(body.vertices(), body.inverse_mass, body.held(), 4);
  const double trace = 1e-3 / std::sqrt(product(start, start));
  for (std::size_t i = 0; i < body.vertices(); ++i) {
    const double mass = body.inverse_mass[i] > 0 ? 1 / body.inverse_mass[i] : 0;
    const Double4 part = splat(std::sqrt(mass)) * load(mode.shape[i]);
    store(start.position[i], splat(trace) * load(start.position[i]) + part);
    store(start.velocity[i], splat(trace) * load(start.velocity[i]) - splat(0.5) * part);
  }
  return start;
}

struct Krylov {
  std::vector<State> basis;
  Eigen::MatrixXd matrix; // Hessenberg matrix
  double left = 0;        // norm of the residual vector
};

Krylov krylov(Amplification& matrix, State start) {
  std::vector<State> basis{std::move(start)};
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(most_products + 1, most_products);
  double norm = std::sqrt(product(basis[0], basis[0]));
  Eigen::Index size = 0;
  for (; size < most_products && norm > 0; ++size) {
    State& last = basis.back();
    for (Records* half : {&last.position, &last.velocity})
      for (Record& r : *half) store(r, splat(1 / norm) * load(r));
    State next;
    next.resize(last.position.size());
    matrix.apply(last, next);
    const double before = std::sqrt(product(next, next));
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t k = 0; k < basis.size(); ++k) {
        const double along = product(basis[k], next);
        h(static_cast<Eigen::Index>(k), size) += along;
        add(-along, basis[k], next);
      }
    norm = std::sqrt(product(next, next));
    if (norm <= 1e-13 * before) norm = 0; // the Krylov space is invariant
    h(size + 1, size) = norm;
    basis.push_back(std::move(next));
  }
  return {std::move(basis), h.topLeftCorner(size, size), norm};
}

} // namespace

namespace {

State combined(const std::vector<State>& basis, const Eigen::VectorXd& weights) {
  State sum;
  sum.resize(basis[0].position.size());
  for (Eigen::Index k = 0; k < weights.size(); ++k) add(weights[k], basis[static_cast<std::size_t>(k)], sum);
  return sum;
}

// For both parts of a complex eigenvector together.
bool is_fast(Amplification& matrix, const Krylov& space, const Eigen::VectorXd& real,
             const Eigen::VectorXd& imaginary) {
  double speeds = 0, accelerations = 0; // squared, in units of √m ω x
  for (const Eigen::VectorXd& weights : {real, imaginary}) {
    const State motion = combined(space.basis, weights);
    speeds += product(motion, motion);
    accelerations += matrix.acceleration(motion);
  }
  return accelerations > fast * fast * speeds;
}

} // namespace

bool grows(const Scheme& scheme, Linearised& body, const HighestMode& mode, double step) {
  const double omega = std::sqrt(mode.omega_squared);
  Amplification matrix(scheme, body, omega, step);
  const Krylov space = krylov(matrix, start_of(body, mode));
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(space.matrix);
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  for (Eigen::Index k = 0; k < space.matrix.rows(); ++k) {
    const std::complex<double> value = solver.eigenvalues()[k];
    const double residual = space.left * std::abs(vectors(space.matrix.rows() - 1, k)) / vectors.col(k).norm();
    if (std::abs(value) <= 1 + 1e-9 + residual) continue;
    if (is_fast(matrix, space, vectors.col(k).real(), vectors.col(k).imag())) return true;
  }
  return false;
}

StepLimit step_limit(const Scheme& scheme, Linearised& body) {
  const HighestMode mode = body.highest();
  StepLimit limit;
  limit.omega = std::sqrt(std::max(mode.omega_squared, 0.0));
  limit.damping_rate = body.damping_rate(mode.shape);
  limit.of_mode = limit.step = step_limit_of_mode(scheme, mode.omega_squared, limit.damping_rate);
  if (limit.of_mode == 0 || std::isinf(limit.of_mode)) return limit;
  const auto stable = [&](double step) { return !grows(scheme, body, mode, step); };
  double low = limit.of_mode * (1 - digits), high = limit.of_mode * (1 + digits);
  if (stable(low) && !stable(high)) return limit; // the highest mode is decisive
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
