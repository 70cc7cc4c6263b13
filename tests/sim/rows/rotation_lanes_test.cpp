// SIMD rotations of four matrices against the scalar reference; no lane may depend on the others.
#include "sim/rows/rotation_lanes.h"

#include "sim/random_meshes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace rend::lanes {
namespace {

using Eigen::Matrix3d;
using meshes::Noise;

struct Turned {
  Matrix<3> R;
  Matrix3d lane(int n) const { return read_lane(R, n); }
};

Turned turned(const std::array<Matrix3d, 4>& four, const Double4& weight = splat(1)) {
  Matrix<3> F;
  for (int n = 0; n < 4; ++n) write_lane(F, n, four[static_cast<std::size_t>(n)]);
  Turned out;
  rotations_of<Rotation::Polar>(F, weight, out.R);
  return out;
}

Matrix3d random_matrix(Noise& noise) {
  Matrix3d F;
  for (int c = 0; c < 3; ++c) F.col(c) = noise.vector();
  return F;
}

// A matrix with singular values `s`, rotated at random on both sides.
Matrix3d stretched(Noise& noise, const Vec3& s) {
  return closest_rotation(random_matrix(noise)) * s.asDiagonal() * closest_rotation(random_matrix(noise));
}

void expect_closest(const std::array<Matrix3d, 4>& four, double tolerance) {
  const Turned out = turned(four);
  for (int n = 0; n < 4; ++n) {
    const Matrix3d& F = four[static_cast<std::size_t>(n)];
    EXPECT_LT((out.lane(n) - closest_rotation(F)).norm(), tolerance) << F;
    EXPECT_LT((out.lane(n).transpose() * out.lane(n) - Matrix3d::Identity()).norm(), tolerance) << F;
    EXPECT_GT(out.lane(n).determinant(), 0.5) << F;
  }
}

TEST(RotationLanes, are_the_closest_rotations) {
  Noise noise(1);
  for (const double spread : {0.0, 1e-9, 1e-4, 0.05, 0.5, 1.0, 2.0}) {
    for (const double size : {1.0, 1e-20, 1e20}) {
      for (int n = 0; n < 200; ++n) {
        std::array<Matrix3d, 4> four;
        for (Matrix3d& F : four) {
          const Vec3 e = spread * noise.vector();
          F = size * stretched(noise, Vec3(std::exp(e.x()), std::exp(e.y()), std::exp(e.z())));
        }
        expect_closest(four, 1e-11);
      }
    }
  }
}

TEST(RotationLanes, are_those_of_the_reference_where_a_direction_is_lost_or_turned_over) {
  Noise noise(2);
  for (const double least : {1e-3, 0.0, -1e-3, -0.3, -0.8}) {
    for (int n = 0; n < 200; ++n) {
      std::array<Matrix3d, 4> four;
      for (Matrix3d& F : four) F = stretched(noise, Vec3(1.2 + 0.1 * noise(), 1 + 0.1 * noise(), least));
      expect_closest(four, 1e-10);
    }
  }
  Matrix3d line = Matrix3d::Zero();
  line(0, 0) = 1;
  for (const Matrix3d& lost : {Matrix3d(Matrix3d::Zero()), line}) {
    const Turned out = turned({lost, Matrix3d::Identity(), lost, Matrix3d::Identity()});
    for (int n = 0; n < 4; ++n) {
      EXPECT_TRUE(out.lane(n).allFinite());
      EXPECT_LT((out.lane(n).transpose() * out.lane(n) - Matrix3d::Identity()).norm(), 1e-12);
    }
  }
}

TEST(RotationLanes, do_not_depend_on_their_neighbours) {
  Noise noise(3);
  for (int n = 0; n < 200; ++n) {
    const Matrix3d F = stretched(noise, Vec3(1, 1 + 0.1 * noise(), 1));
    const Matrix3d alone = turned({F, F, F, F}).lane(0);
    const Matrix3d hard = stretched(noise, Vec3(1, 0.05 + 0.02 * noise(), 0.02));
    EXPECT_EQ(turned({F, hard, Matrix3d::Zero(), -F}).lane(0), alone);
    EXPECT_EQ(turned({hard, hard, hard, F}).lane(3), alone);
  }
}

TEST(RotationLanes, of_padding_are_none) {
  const Turned out =
      turned({Matrix3d::Zero(), Matrix3d::Identity(), Matrix3d::Zero(), Matrix3d::Zero()}, Double4{0, 1, 0, 0});
  EXPECT_EQ(out.lane(0), Matrix3d::Zero());
  EXPECT_EQ(out.lane(1), Matrix3d::Identity());
}

} // namespace
} // namespace rend::lanes
