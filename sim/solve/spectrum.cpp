#include "sim/solve/spectrum.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace rend {
namespace {

// The splitmix64 generator: Steele, Lea & Flood 2014.
double splitmix(std::uint64_t& state) {
  std::uint64_t z = state += 0x9e3779b97f4a7c15ULL;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ z >> 27) * 0x94d049bb133111ebULL;
  return static_cast<double>((z ^ z >> 31) >> 11) * 0x1p-52 - 1;
}

class Lanczos {
public:
  Lanczos(const BlockMatrix& stiffness, const double* inverse_mass, const std::vector<std::uint8_t>& held)
      : stiffness_(&stiffness), held_(&held), root_(stiffness.rows()), scaled_(stiffness.rows()) {
    for (std::size_t i = 0; i < root_.size(); ++i) root_[i] = std::sqrt(inverse_mass[i]);
  }

  HighestMode run(double tolerance, int most);

private:
  void multiply(const Records& x, Records& y);
  void orthogonalise(Records& x) const;
  double largest(Eigen::VectorXd& weights) const;

  const BlockMatrix* stiffness_;
  const std::vector<std::uint8_t>* held_;
  std::vector<double> root_;           // m^(−1/2), one per vertex slot
  Records scaled_;                     // scratch
  std::vector<Records> basis_;         // orthonormal
  std::vector<double> diagonal_, off_; // of the tridiagonal matrix [1/s²]
};

// y = M^(−1/2) K M^(−1/2) x
void Lanczos::multiply(const Records& x, Records& y) {
  for (std::size_t i = 0; i < x.size(); ++i) store(scaled_[i], splat(root_[i]) * load(x[i]));
  stiffness_->multiply(scaled_.data(), y.data());
  for (std::size_t i = 0; i < y.size(); ++i) store(y[i], free_axes((*held_)[i]) * splat(root_[i]) * load(y[i]));
}

void Lanczos::orthogonalise(Records& x) const {
  for (int twice = 0; twice < 2; ++twice)
    for (const Records& known : basis_) add_scaled(1, -dot(1, known, x), known, x);
}

double Lanczos::largest(Eigen::VectorXd& weights) const {
  const auto n = static_cast<Eigen::Index>(diagonal_.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal_.data(), n),
                                Eigen::Map<const Eigen::VectorXd>(off_.data(), n - 1));
  weights = solver.eigenvectors().col(n - 1); // eigenvalues are in increasing order
  return solver.eigenvalues()[n - 1];
}

HighestMode Lanczos::run(double tolerance, int most) {
  HighestMode mode;
  const std::size_t count = root_.size();
  mode.shape.assign(count, Record{});
  std::vector<double> inverse(count);
  for (std::size_t i = 0; i < count; ++i) inverse[i] = root_[i];
  Records next = scattered(count, inverse.data(), *held_, 1);
  double norm = std::sqrt(dot(1, next, next));
  Eigen::VectorXd weights;
  while (norm > 0 && mode.iterations < most) {
    basis_.push_back(std::move(next));
    Records& last = basis_.back();
    for (Record& r : last) store(r, splat(1 / norm) * load(r));
    next.assign(count, Record{});
    multiply(last, next);
    diagonal_.push_back(dot(1, last, next));
    ++mode.iterations;
    orthogonalise(next);
    norm = std::sqrt(dot(1, next, next));
    mode.omega_squared = largest(weights);
    const double left = norm * std::abs(weights[weights.size() - 1]);
    mode.residual = mode.omega_squared > 0 ? left / mode.omega_squared : 0;
    if (left <= tolerance * std::abs(mode.omega_squared)) break;
    off_.push_back(norm);
  }
  for (std::size_t k = 0; k < basis_.size(); ++k)
    add_scaled(1, weights[static_cast<Eigen::Index>(k)], basis_[k], mode.shape);
  for (std::size_t i = 0; i < count; ++i) store(mode.shape[i], splat(root_[i]) * load(mode.shape[i]));
  return mode;
}

} // namespace

Records scattered(std::size_t count, const double* inverse_mass, const std::vector<std::uint8_t>& held,
                  std::uint64_t seed) {
  Records x(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double a = splitmix(seed), b = splitmix(seed), c = splitmix(seed);
    if (inverse_mass[i] > 0) store(x[i], free_axes(held[i]) * Double4{a, b, c, 0});
  }
  return x;
}

HighestMode highest_mode(const BlockMatrix& stiffness, const double* inverse_mass,
                         const std::vector<std::uint8_t>& held, double tolerance, int most) {
  return Lanczos(stiffness, inverse_mass, held).run(tolerance, most);
}

} // namespace rend
