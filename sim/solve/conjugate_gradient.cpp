#include "sim/solve/conjugate_gradient.h"

#include "sim/base/stop_request.h"

#include <cmath>

namespace rend {
namespace {

void gather(const std::vector<std::uint32_t>& order, const Records& from, Records& to) {
  to.resize(from.size());
  for (std::size_t k = 0; k < order.size(); ++k) to[k] = from[order[k]];
}

void multiply(const std::vector<Block3>& blocks, const Records& x, Records& y) {
  for (std::size_t k = 0; k < blocks.size(); ++k) store(y[k], times(blocks[k], x[k]));
}

} // namespace

ConjugateGradient::Result ConjugateGradient::solve(Preconditioner& preconditioner, int parts, const Records& b,
                                                   Records& x, double tolerance, int most) {
  gather(preconditioner.order(), b, residual_);
  preconditioner.forward(residual_, residual_);
  for (Records* each : {&corrected_, &moved_, &image_}) each->resize(b.size());
  sum_.assign(b.size(), Record{});
  multiply(preconditioner.pivots(), residual_, corrected_);
  direction_ = corrected_;
  double energy = dot(parts, residual_, corrected_);
  const double goal = tolerance * tolerance * energy;
  Result result;
  while (!(result.converged = energy <= goal) && result.iterations < most) {
    throw_if_stop_is_due();
    preconditioner.product(direction_, moved_, image_);
    const double curvature = dot(parts, direction_, image_);
    if (!(curvature > 0)) break;
    const double along = energy / curvature;
    add_scaled(parts, along, moved_, sum_);
    add_scaled(parts, -along, image_, residual_);
    multiply(preconditioner.pivots(), residual_, corrected_);
    const double before = energy;
    energy = dot(parts, residual_, corrected_);
    scale_and_add(parts, energy / before, corrected_, direction_);
    ++result.iterations;
  }
  x.resize(b.size());
  for (std::size_t k = 0; k < b.size(); ++k) x[preconditioner.order()[k]] = sum_[k];
  return result;
}

} // namespace rend
