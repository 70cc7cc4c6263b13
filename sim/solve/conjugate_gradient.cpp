#include "sim/solve/conjugate_gradient.h"

#include <cmath>

namespace rend {

ConjugateGradient::Result ConjugateGradient::solve(const BlockMatrix& matrix,
                                                   const Preconditioner& preconditioner, const Records& b,
                                                   Records& x, double tolerance, int most) {
  const int parts = matrix.pattern()->parts;
  x.assign(b.size(), Record{});
  residual_ = b;
  corrected_.resize(b.size());
  image_.resize(b.size());
  const double goal = tolerance * std::sqrt(dot(parts, b, b));
  preconditioner.apply(residual_.data(), corrected_.data());
  direction_ = corrected_;
  double energy = dot(parts, residual_, corrected_);
  Result result;
  while (true) {
    if (std::sqrt(dot(parts, residual_, residual_)) <= goal) {
      result.converged = true;
      return result;
    }
    if (result.iterations == most) return result;
    matrix.multiply(direction_.data(), image_.data());
    const double curvature = dot(parts, direction_, image_);
    if (!(curvature > 0)) return result;
    const double along = energy / curvature;
    add_scaled(parts, along, direction_, x);
    add_scaled(parts, -along, image_, residual_);
    preconditioner.apply(residual_.data(), corrected_.data());
    const double before = energy;
    energy = dot(parts, residual_, corrected_);
    scale_and_add(parts, energy / before, corrected_, direction_);
    ++result.iterations;
  }
}

} // namespace rend
