#include "sim/mechanics/enhanced_modes.h"

#include "sim/mechanics/element_law.h"

#include <Eigen/LU>

namespace rend {
namespace {

// J in the middle, with respect to the axes: the gradients there are the means of those at the points.
Eigen::MatrixXd middle_jacobian(const ElementShape& shape, const Vec3* rest, const Eigen::Matrix3d& frame) {
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
  for (const ReferencePoint& point : shape.points)
    for (std::size_t n = 1; n < static_cast<std::size_t>(shape.corners); ++n)
      J += frame.transpose() * (rest[n] - rest[0]) *
           Eigen::Map<const Eigen::RowVector3d>(point.gradient[n].data()) /
           static_cast<double>(shape.points.size());
  return J.topLeftCorner(shape.dimension, shape.dimension);
}

} // namespace

void write_enhanced_modes(const ElementShape& shape, const Vec3* rest, const Eigen::Matrix3d& frame,
                          const ElasticMaterial& material, const double* points, double* values) {
  const int dim = shape.dimension, modes = dim * dim;
  const int stride = dim * dim + 1, count = static_cast<int>(shape.points.size());
  double volume = 0;                                       // [m³]
  Eigen::MatrixXd signs = Eigen::MatrixXd::Zero(dim, dim); // Σ ± ± / w
  for (int g = 0; g < count; ++g) {
    const double w = points[stride * g + dim * dim];
    volume += w;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b) signs(a, b) += ((g >> a & 1) == (g >> b & 1) ? 1 : -1) / w;
  }
  const Eigen::MatrixXd H = volume / count * middle_jacobian(shape, rest, frame).inverse(); // rows H_a
  const double lambda = material.lambda, mu = material.mu;
  Eigen::MatrixXd D(modes, modes);
  for (int a = 0; a < dim; ++a)
    for (int b = 0; b < dim; ++b)
      D.block(dim * a, dim * b, dim, dim) =
          signs(a, b) * (lambda * H.row(a).transpose() * H.row(b) + mu * H.row(b).transpose() * H.row(a) +
                         mu * H.row(a).dot(H.row(b)) * Eigen::MatrixXd::Identity(dim, dim));
  const Eigen::MatrixXd inverse = D.inverse();
  for (int a = 0; a < dim; ++a)
    for (int c = 0; c < dim; ++c) *values++ = H(a, c);
  for (int r = 0; r < modes; ++r)
    for (int c = r; c < modes; ++c) *values++ = 0.5 * (inverse(r, c) + inverse(c, r));
}

} // namespace rend
