#include "sim/solve/linear_solver.h"

#include <algorithm>

namespace rend {
namespace {

constexpr double direct_below = 40; // iterations
constexpr std::size_t most_blocks = 10'000'000;
constexpr double single_from = 1e-2; // tolerance
constexpr int least_iterations = 100, most_iterations = 20'000;

} // namespace

void LinearSolver::set_matrix(const BlockMatrix& matrix) {
  matrix_ = &matrix;
  factor_.analyse(matrix.pattern());
  factored_ = preconditioned_ = false;
  if (direct_left_ > 0) --direct_left_;
}

bool LinearSolver::factor_fits() const {
  return factor_.blocks() <= most_blocks;
}

double LinearSolver::factorisation_cost() const {
  return factor_.products() / static_cast<double>(matrix_->pattern()->blocks());
}

bool LinearSolver::direct() const {
  return factored_ || ((factorisation_cost() <= direct_below || direct_left_ > 0) && factor_fits());
}

Definiteness LinearSolver::factorise() {
  if (!factor_fits()) return Definiteness::Positive;
  if (!factored_) {
    definiteness_ = factor_.factorise(*matrix_);
    factored_ = true;
    ++factorisations_;
  }
  return definiteness_;
}

bool LinearSolver::iterate(const Records& b, Records& x, double tolerance) {
  const Precision precision = tolerance < single_from ? Precision::Double : Precision::Single;
  if (!preconditioned_ || (precision == Precision::Double && precision_ == Precision::Single))
    preconditioned_ = preconditioner_.set_matrix(*matrix_, precision_ = precision);
  if (!preconditioned_) return false;
  const int most =
      !factor_fits()
          ? most_iterations
          : static_cast<int>(std::clamp<double>(factorisation_cost(), least_iterations, most_iterations));
  const auto result = gradient_.solve(preconditioner_, matrix_->pattern()->parts, b, x, tolerance, most);
  iterations_ += result.iterations;
  return result.converged;
}

bool LinearSolver::solve(const Records& b, Records& x, double tolerance) {
  const bool at_once = direct();
  if (!at_once && iterate(b, x, tolerance)) return true;
  if (!at_once) direct_left_ = direct_streak;
  if (!factor_fits() || factorise() == Definiteness::Singular) return false;
  x.resize(b.size());
  factor_.solve(b.data(), x.data());
  return true;
}

} // namespace rend
