// Rotations against brute force and finite differences.
#include "sim/mechanics/rotation.h"

#include "sim/elements.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace rend::rotation_test {
namespace {

using Eigen::Matrix3d;
using elements::Noise;

Matrix3d random_matrix(Noise& noise, double amount, bool sheet) {
  Matrix3d F;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) F(r, c) = (r == c) + amount * noise();
  if (sheet) F.col(2).setZero();
  return elements::random_rotation(noise) * F;
}

TEST(ClosestRotation, is_a_rotation_and_no_other_is_closer) {
  Noise noise(1);
  for (int n = 0; n < 300; ++n) {
    const bool sheet = n % 3 == 0;
    const Matrix3d F = random_matrix(noise, n % 5 == 0 ? 3 : 0.5, sheet);
    const Matrix3d R = sheet ? closest_sheet_rotation(F) : closest_rotation(F);
    EXPECT_LT((R.transpose() * R - Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_NEAR(R.determinant(), 1, 1e-14);
    EXPECT_LT((closest_rotation(F) - R).norm(), 1e-10); // for a sheet, that of the matrix with a zero column
    for (int m = 0; m < 50; ++m) {
      const Matrix3d Q = elements::random_rotation(noise);
      EXPECT_GE((R.transpose() * F).trace(), (Q.transpose() * F).trace() - 1e-12);
    }
    const Matrix3d S = R.transpose() * F;
    EXPECT_LT((S - S.transpose()).norm(), 1e-12 * (1 + F.norm()));
  }
}

TEST(ClosestRotation, is_finite_for_what_has_lost_its_directions) {
  Noise noise(2);
  for (const Vec3& scale :
       {Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(1, 1, 1e-15), Vec3(1e-200, 1, 1)}) {
    for (int n = 0; n < 20; ++n) {
      const Matrix3d F =
          elements::random_rotation(noise) * scale.asDiagonal() * elements::random_rotation(noise);
      for (const Matrix3d& R : {closest_rotation(F), gram_schmidt(F, 3)}) {
        EXPECT_LT((R.transpose() * R - Matrix3d::Identity()).norm(), 1e-13);
        EXPECT_NEAR(R.determinant(), 1, 1e-13);
      }
      Matrix3d sheet = F;
      sheet.col(2).setZero();
      for (const Matrix3d& R : {closest_sheet_rotation(sheet), gram_schmidt(sheet, 2)})
        EXPECT_LT((R.transpose() * R - Matrix3d::Identity()).norm(), 1e-13);
    }
  }
}

TEST(RotationDerivative, is_how_the_rotation_turns) {
  Noise noise(3);
  for (const Rotation rotation : {Rotation::Polar, Rotation::Qr}) {
    for (int n = 0; n < 40; ++n) {
      const bool sheet = n % 2 == 0;
      const Matrix3d F = random_matrix(noise, 0.4, sheet);
      const auto turned = [&](const Matrix3d& G) {
        if (rotation == Rotation::Qr) return gram_schmidt(G, sheet ? 2 : 3);
        return sheet ? closest_sheet_rotation(G) : closest_rotation(G);
      };
      const Vec3 a = noise.vector();
      Vec3 b = noise.vector();
      if (sheet) b.z() = 0;
      const double h = 1e-6;
      const Matrix3d ahead = turned(F + h * a * b.transpose()), behind = turned(F - h * a * b.transpose());
      const Matrix3d R = turned(F), rate = R.transpose() * (ahead - behind) / (2 * h);
      const Vec3 spin = RotationDerivative(rotation, R, F).of(b) * (R.transpose() * a);
      EXPECT_LT((Vec3(rate(2, 1), rate(0, 2), rate(1, 0)) - spin).norm(), 1e-7 * (1 + spin.norm()));
    }
  }
}

} // namespace
} // namespace rend::rotation_test
