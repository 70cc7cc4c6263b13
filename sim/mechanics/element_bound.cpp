// The largest eigenvalue of an element's stiffness.
//
// For a simplex B is constant: u = M⁻¹ w σ G gives ε = w sym(H σ) with H = Σ G_n G_nᵀ/m_n. In the principal
// axes of H the shear modes decouple, w μ (h_i + h_j), never above the largest of the three stretch modes,
// those of w (2μ D + λ √h √hᵀ) with D = diag(h): two problems of 3 × 3 instead of one of 12 × 12, 1 µs where
// the latter takes 10.
#include "sim/mechanics/element_law.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace rend {
namespace {

using Eigen::Matrix3d;

double largest_of(const Matrix3d& m) {
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(m, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

// Gradients at an integration point, each divided by the square root of the mass of its corner.
Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, most_particles>
weighed_gradients(const ElementShape& shape, std::size_t g, const double* inverse, const double* mass) {
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, most_particles> gradient(3, shape.corners);
  const int dim = shape.dimension;
  for (int n = 0; n < shape.corners; ++n) {
    const auto& reference = shape.points[g].gradient[static_cast<std::size_t>(n)];
    const double scale = !mass ? 1 : mass[n] > 0 ? 1 / std::sqrt(mass[n]) : 0;
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      if (c < dim)
        for (int r = 0; r < dim; ++r) sum += inverse[r * dim + c] * reference[static_cast<std::size_t>(r)];
      gradient(c, n) = scale * sum;
    }
  }
  return gradient;
}

double largest_of_simplex(const ElementShape& shape, const double* point, const ElasticMaterial& m,
                          const double* mass) {
  const auto gradient = weighed_gradients(shape, 0, point, mass);
  const Matrix3d H = gradient * gradient.transpose();
  const Vec3 h = Eigen::SelfAdjointEigenSolver<Matrix3d>(H, Eigen::EigenvaluesOnly).eigenvalues().cwiseMax(0);
  const Vec3 root = h.cwiseSqrt();
  Matrix3d stretch = m.lambda * root * root.transpose();
  stretch.diagonal() += 2 * m.mu * h;
  return point[shape.dimension * shape.dimension] * largest_of(stretch);
}

} // namespace

double largest_stiffness(const ElementShape& shape, const double* points, const ElasticMaterial& m,
                         const double* mass) {
  if (shape.points.size() == 1) return largest_of_simplex(shape, points, m, mass);
  const int dim = shape.dimension, size = dim * shape.corners;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t g = 0; g < shape.points.size(); ++g, points += dim * dim + 1) {
    const auto gradient = weighed_gradients(shape, g, points, mass);
    const double lambda = points[dim * dim] * m.lambda, mu = points[dim * dim] * m.mu;
    for (int i = 0; i < shape.corners; ++i)
      for (int j = 0; j <= i; ++j) { // the lower triangle, which the solver reads
        const double both = mu * gradient.col(i).dot(gradient.col(j));
        for (int r = 0; r < dim; ++r) {
          for (int c = 0; c < dim; ++c)
            K(dim * i + r, dim * j + c) +=
                lambda * gradient(r, i) * gradient(c, j) + mu * gradient(r, j) * gradient(c, i);
          K(dim * i + r, dim * j + r) += both;
        }
      }
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues()[size - 1];
}

} // namespace rend
