// Forces of single elements against differences of their energy, computed by itself in long double.
#include "sim/mechanics/element_law.h"

#include "sim/elements.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <gtest/gtest.h>

namespace rend::element_gradient_test {
namespace {

using namespace elements;
using Eigen::Matrix3d;

// The energy of an element from its corners alone: R of the average F, or of each point's own F in a sheet, and
// Σ w (μ|ε|² + λ/2 (tr ε)²) at the points, in long double, with R from a singular value decomposition. It
// shares with the law only the table of shape functions and J⁻¹.
using Long = long double;
using LongMatrix = Eigen::Matrix<Long, 3, 3>;

LongMatrix long_frame(const LongMatrix& F, Rotation rotation) {
  LongMatrix R = LongMatrix::Zero();
  const int columns = F.col(2).isZero(0) ? 2 : 3;
  if (rotation == Rotation::Qr) {
    R.col(0) = F.col(0).normalized();
    R.col(1) = (F.col(1) - R.col(0).dot(F.col(1)) * R.col(0)).normalized();
    R.col(2) = R.col(0).cross(R.col(1));
    return R;
  }
  const Eigen::JacobiSVD<LongMatrix> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  LongMatrix U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0) U.col(2) *= -1;
  R = U * svd.matrixV().transpose();
  if (columns == 2) R.col(2) = R.col(0).cross(R.col(1));
  return R;
}

struct LongPoints {
  std::vector<LongMatrix> F, R;     // at each integration point
  std::vector<LongMatrix> frame_of; // F of each frame
  std::vector<Long> weight;
};

LongPoints long_points(const Element& e) {
  const ElementShape& shape = e.law->shape();
  const auto size = static_cast<Eigen::Index>(shape.dimension);
  LongPoints points;
  LongMatrix mean = LongMatrix::Zero();
  Long volume = 0;
  const double* value = e.unit.data() + e.law->first_point(); // J⁻¹ and w
  for (const ReferencePoint& point : shape.points) {
    LongMatrix inverse = LongMatrix::Zero(), from = LongMatrix::Zero();
    for (Eigen::Index r = 0; r < size; ++r)
      for (Eigen::Index c = 0; c < size; ++c) inverse(r, c) = *value++;
    for (std::size_t n = 0; n < e.corners(); ++n)
      for (int axis = 0; axis < 3; ++axis)
        from.col(axis) += static_cast<Long>(point.gradient[n][static_cast<std::size_t>(axis)]) *
                          (e.x[n] - e.x[0]).cast<Long>();
    points.F.push_back(from * inverse);
    points.weight.push_back(*value++);
    mean += points.weight.back() * points.F.back();
    volume += points.weight.back();
  }
  mean /= volume;
  points.frame_of = {mean};
  if (rotates_per_point(shape.dimension, static_cast<int>(points.F.size()))) points.frame_of = points.F;
  for (std::size_t g = 0; g < points.F.size(); ++g)
    points.R.push_back(long_frame(points.frame_of[points.frame_of.size() == 1 ? 0 : g], e.law->rotation()));
  if (e.law->model() == ElasticModel::Corotational) return points;
  LongMatrix still = LongMatrix::Identity();
  if (size == 2) still = rest_frame(shape, e.rest.data()).cast<Long>();
  points.R.assign(points.F.size(), still);
  return points;
}

using LongVector = Eigen::Matrix<Long, Eigen::Dynamic, 1>;

// Strains of unit amplitudes of the enhanced modes at each point: sym(e_c H_aᵀ) ± 1/w with H_a = J₀⁻ᵀ e_a.
std::vector<std::vector<LongMatrix>> mode_strains(const Element& e, const LongPoints& points) {
  const ElementShape& shape = e.law->shape();
  const Eigen::Index dim = shape.dimension;
  const bool own =
      dim == 2 || (e.law->model() == ElasticModel::Corotational && e.law->rotation() == Rotation::Qr);
  const Matrix3d frame = own ? rest_frame(shape, e.rest.data()) : Matrix3d(Matrix3d::Identity());
  LongMatrix J = LongMatrix::Zero();
  for (std::size_t n = 0; n < e.corners(); ++n)
    for (const ReferencePoint& point : shape.points)
      J += (frame.transpose() * e.rest[n] * Eigen::Map<const Eigen::RowVector3d>(point.gradient[n].data()))
               .cast<Long>();
  if (dim == 2) J.row(2) << 0, 0, 1;
  const LongMatrix inverse = J.inverse();
  std::vector<std::vector<LongMatrix>> all(points.F.size());
  for (std::size_t g = 0; g < all.size(); ++g) {
    for (Eigen::Index a = 0; a < dim; ++a) {
      for (Eigen::Index c = 0; c < dim; ++c) {
        LongMatrix M = LongMatrix::Zero();
        M.row(c) = (g >> a & 1 ? 1 : -1) / points.weight[g] * inverse.row(a);
        all[g].push_back((M + M.transpose()) / 2);
      }
    }
  }
  return all;
}

// Σ w ψ(ε), the least of all amplitudes of the modes.
Long long_energy(const Element& e) {
  const LongPoints points = long_points(e);
  const Eigen::Index size = e.law->shape().dimension;
  const ElasticMaterial& m = e.law->material();
  const auto product = [&](const LongMatrix& a, const LongMatrix& b) { // a : C b
    return 2 * m.mu * a.cwiseProduct(b).sum() + m.lambda * a.trace() * b.trace();
  };
  std::vector<std::vector<LongMatrix>> modes;
  if (e.law->formulation() == Formulation::Enhanced) modes = mode_strains(e, points);
  const auto count = static_cast<Eigen::Index>(modes.empty() ? 0 : modes[0].size());
  Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic> D =
      Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>::Zero(count, count);
  LongVector r = LongVector::Zero(count);
  Long sum = 0;
  for (std::size_t g = 0; g < points.F.size(); ++g) {
    const LongMatrix U = points.R[g].transpose() * points.F[g];
    LongMatrix strain = (U + U.transpose()) / 2;
    if (size == 2) strain.row(2).setZero(), strain.col(2).setZero();
    for (Eigen::Index c = 0; c < size; ++c) strain(c, c) -= 1;
    sum += points.weight[g] / 2 * product(strain, strain);
    for (Eigen::Index i = 0; i < count; ++i) {
      const LongMatrix& mode = modes[g][static_cast<std::size_t>(i)];
      r[i] += points.weight[g] * product(mode, strain);
      for (Eigen::Index j = 0; j < count; ++j)
        D(i, j) += points.weight[g] * product(mode, modes[g][static_cast<std::size_t>(j)]);
    }
  }
  return count == 0 ? sum : sum - r.dot(LongVector(D.ldlt().solve(r))) / 2;
}

// Whether a frame is so close to a flip that the moment on it is bounded (rotation.h): the force is finite
// there instead of the gradient.
bool about_to_flip(const Element& e) {
  if (e.law->model() == ElasticModel::Linear) return false;
  const LongPoints points = long_points(e);
  for (const LongMatrix& F : points.frame_of) {
    const LongMatrix U = long_frame(F, e.law->rotation()).transpose() * F;
    if (e.law->rotation() == Rotation::Qr && std::min(U(0, 0), U(1, 1)) < 2 * least_qr) return true;
    const LongMatrix H = U.trace() * LongMatrix::Identity() - U;
    if (e.law->rotation() == Rotation::Polar && H.determinant() < 2 * least_polar) return true;
  }
  return false;
}

// −∂U/∂x of that energy, by differences.
std::vector<Vec3> long_forces(Element e) {
  std::vector<Vec3> f(e.corners());
  const double h = 1e-6;
  for (std::size_t n = 0; n < e.corners(); ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      const double x = e.x[n][axis];
      e.x[n][axis] = x + h;
      const Long ahead = long_energy(e), to = e.x[n][axis];
      e.x[n][axis] = x - h;
      const Long behind = long_energy(e), from = e.x[n][axis];
      e.x[n][axis] = x;
      f[n][axis] = static_cast<double>((behind - ahead) / (to - from));
    }
  }
  return f;
}

// From small strains to elements turned inside out.
TEST(ElementLaw, force_is_minus_the_gradient_of_the_energy) {
  int compared = 0, flips = 0;
  for (const double amount : {0.05, 0.3, 0.8, 2.0}) {
    for_each_element(0.15, 0, [&](const Element& start, const std::string& name) {
      for (unsigned seed = 1; seed < 9; ++seed) {
        SCOPED_TRACE(name + ", displaced by " + std::to_string(amount) + ", seed " + std::to_string(seed));
        Element e = start;
        Noise noise(seed);
        if (e.law->model() == ElasticModel::Corotational) e.turn(random_rotation(noise));
        e.shake(amount, seed);
        EXPECT_NEAR(e.energy(), static_cast<double>(long_energy(e)), 1e-11 * e.energy());
        if (about_to_flip(e)) {
          ++flips;
          continue;
        }
        ++compared;
        const std::vector<Vec3> f = e.forces(), expected = long_forces(e);
        for (std::size_t n = 0; n < e.corners(); ++n) EXPECT_LT((f[n] - expected[n]).norm(), 1e-7 * largest(f));
      }
    });
  }
  EXPECT_LT(20 * flips, compared);
}

} // namespace
} // namespace rend::element_gradient_test
