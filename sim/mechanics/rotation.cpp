#include "sim/mechanics/rotation.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

using Eigen::Matrix3d;

constexpr double lost = 1e-12; // relative length below which a vector counts as 0

Matrix3d cofactors(const Matrix3d& F) {
  Matrix3d C;
  C << F.col(1).cross(F.col(2)), F.col(2).cross(F.col(0)), F.col(0).cross(F.col(1));
  return C;
}

Matrix3d rotation_by_singular_values(const Matrix3d& F) {
  const Eigen::JacobiSVD<Matrix3d> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0) U.col(2) *= -1;
  return U * svd.matrixV().transpose();
}

Vec3 any_normal(const Vec3& v) { // a unit vector orthogonal to v
  const Vec3 a = v.cwiseAbs();
  const Vec3 axis = a.x() <= a.y() && a.x() <= a.z() ? Vec3::UnitX()
                    : a.y() <= a.z()                 ? Vec3::UnitY()
                                                     : Vec3::UnitZ();
  const Vec3 normal = v.cross(axis);
  return normal.norm() > 0 ? Vec3(normal.normalized()) : Vec3(Vec3::UnitY());
}

} // namespace

Matrix3d closest_rotation(const Matrix3d& F) {
  Matrix3d R = F;
  for (int n = 0; n < 8; ++n) {
    const Matrix3d C = cofactors(R);
    const double determinant = R.col(0).dot(C.col(0));
    if (!(determinant > 0)) break; // inverted, or flat
    const Matrix3d change = 0.5 / determinant * C - 0.5 * R;
    R += change;
    if (change.squaredNorm() < 1e-15) return R; // quadratic convergence: the remaining error is half of it
  }
  return rotation_by_singular_values(F);
}

// In the plane of Gram–Schmidt's frame F is the triangular matrix (p q; 0 r), whose polar rotation is known in
// closed form.
Matrix3d closest_sheet_rotation(const Matrix3d& F) {
  const double p = F.col(0).norm();
  if (!(p > lost * F.col(1).norm())) return rotation_by_singular_values(F);
  const Vec3 a = F.col(0) / p;
  const double q = a.dot(F.col(1));
  const Vec3 rest = F.col(1) - q * a;
  const double r = rest.norm();
  if (!(r > 1e-3 * (p + F.col(1).norm()))) return rotation_by_singular_values(F);
  const Vec3 b = rest / r;
  const double c = p + r, s = -q, h = std::sqrt(c * c + s * s);
  Matrix3d R;
  R.col(0) = (c * a + s * b) / h;
  R.col(1) = (c * b - s * a) / h;
  R.col(2) = a.cross(b);
  return R;
}

Matrix3d gram_schmidt(const Matrix3d& F, int dimension) {
  const double least = lost * F.norm();
  Matrix3d R;
  if (F.col(0).norm() > least)
    R.col(0) = F.col(0).normalized();
  else
    R.col(0) = any_normal(F.col(1));
  const Vec3 second = F.col(1) - R.col(0).dot(F.col(1)) * R.col(0);
  const Vec3 third = F.col(2) - R.col(0).dot(F.col(2)) * R.col(0);
  if (second.norm() > least)
    R.col(1) = second.normalized();
  else if (dimension == 3 && third.norm() > least)
    R.col(1) = third.normalized().cross(R.col(0));
  else
    R.col(1) = any_normal(R.col(0));
  // Orthogonalised a second time: if the difference is small, round-off leaves it not quite orthogonal.
  R.col(1) = (R.col(1) - R.col(0).dot(R.col(1)) * R.col(0)).normalized();
  R.col(2) = R.col(0).cross(R.col(1));
  return R;
}

RotationDerivative::RotationDerivative(Rotation rotation, const Matrix3d& R, const Matrix3d& F)
    : rotation_(rotation) {
  Matrix3d U = R.transpose() * F;
  const double size = U.norm();
  if (rotation == Rotation::Qr) {
    turns_ = U(0, 0) > lost * size && U(1, 1) > lost * size;
    if (turns_) inverse_ = system(U).inverse();
    U(0, 0) = std::max(U(0, 0), least_qr);
    U(1, 1) = std::max(U(1, 1), least_qr);
    bounded_ = system(U).inverse();
    return;
  }
  const Matrix3d H = system(0.5 * (U + U.transpose()));
  const double determinant = H.determinant();
  const Matrix3d adjugate = cofactors(H); // H is symmetric
  turns_ = determinant > 1e-9 * size * size * size;
  if (turns_) inverse_ = H.inverse();
  bounded_ = adjugate / std::max(determinant, least_polar);
}

Matrix3d RotationDerivative::system(const Matrix3d& U) const {
  if (rotation_ == Rotation::Polar) return U.trace() * Matrix3d::Identity() - U;
  Matrix3d H = Matrix3d::Zero();
  H(0, 0) = U(1, 1);
  H(0, 1) = -U(0, 1);
  H(1, 1) = -U(0, 0);
  H(2, 2) = U(0, 0);
  return H;
}

Matrix3d RotationDerivative::back(const Vec3& z) const {
  if (rotation_ == Rotation::Polar) return cross_matrix(z);
  Matrix3d Z = Matrix3d::Zero();
  Z(2, 1) = z.x();
  Z(2, 0) = z.y();
  Z(1, 0) = z.z();
  return Z;
}

Matrix3d RotationDerivative::of(const Vec3& b) const {
  if (!turns_) return Matrix3d::Zero();
  if (rotation_ == Rotation::Polar) return inverse_ * cross_matrix(b);
  Matrix3d L = Matrix3d::Zero();
  L(0, 2) = b.y();
  L(1, 2) = b.x();
  L(2, 1) = b.x();
  return inverse_ * L;
}

RotationDerivative::Moment RotationDerivative::moment(const Vec3& t) const {
  const Vec3 z = bounded_.transpose() * t;
  return {z, back(z)};
}

Matrix3d RotationDerivative::moment_change(const Vec3& z, const Vec3& dt, const Matrix3d& dU) const {
  return back(bounded_.transpose() * (dt - system(dU).transpose() * z));
}

} // namespace rend
