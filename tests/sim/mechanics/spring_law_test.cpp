#include "sim/mechanics/spring_law.h"

#include "sim/random_meshes.h"

#include <gtest/gtest.h>

namespace rend::spring_law_test {
namespace {

using meshes::Noise;

const Vec3 zero = Vec3::Zero();

TEST(Spring, pulls_when_long_and_pushes_when_short) {
  const UnitParameters p{10, 0, 1};
  EXPECT_EQ(spring_force(p, zero, Vec3(1.5, 0, 0), zero, zero), Vec3(5, 0, 0));
  EXPECT_EQ(spring_force(p, zero, Vec3(0.5, 0, 0), zero, zero), Vec3(-5, 0, 0));
  EXPECT_EQ(spring_force(p, zero, Vec3(1, 0, 0), zero, zero), zero);
}

TEST(Spring, force_is_minus_the_gradient_of_its_energy) {
  Noise noise(1);
  constexpr double h = 1e-6;
  for (int n = 0; n < 200; ++n) {
    const UnitParameters p{7, 0, 0.8};
    const Vec3 xi = noise.vector(), xj = noise.vector() + Vec3(1.5, 0, 0);
    const Vec3 f = spring_force(p, xi, xj, zero, zero);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 by = h * Vec3::Unit(axis);
      const double slope = (spring_energy(p, xi + by, xj) - spring_energy(p, xi - by, xj)) / (2 * h);
      EXPECT_NEAR(f[axis], -slope, 1e-7);
    }
  }
}

TEST(Spring, acts_on_both_ends_alike_and_turns_nothing) {
  Noise noise(2);
  for (int n = 0; n < 200; ++n) {
    const UnitParameters p{7, 0.4, 0.8};
    const Vec3 xi = noise.vector(), xj = noise.vector(), vi = noise.vector(), vj = noise.vector();
    const Vec3 f = spring_force(p, xi, xj, vi, vj), g = spring_force(p, xj, xi, vj, vi);
    EXPECT_LT((f + g).norm(), 1e-14 * f.norm());
    EXPECT_LT((xi.cross(f) + xj.cross(-f)).norm(), 1e-14 * f.norm() * (xi.norm() + xj.norm()));
  }
}

TEST(Spring, damping_dissipates) {
  Noise noise(3);
  for (int n = 0; n < 200; ++n) {
    const Vec3 xi = noise.vector(), xj = noise.vector(), vi = noise.vector(), vj = noise.vector();
    const Vec3 f = spring_force({0, 0.4, 0}, xi, xj, vi, vj);
    EXPECT_LE(f.dot(vi) - f.dot(vj), 0);
  }
  // only along the spring
  EXPECT_EQ(spring_force({0, 2, 1}, zero, Vec3(1, 0, 0), zero, Vec3(3, 5, 0)), Vec3(6, 0, 0));
}

TEST(Spring, without_length_gives_no_force) {
  EXPECT_EQ(spring_force({10, 3, 1}, Vec3(1, 2, 3), Vec3(1, 2, 3), zero, Vec3(1, 1, 1)), zero);
}

} // namespace
} // namespace rend::spring_law_test
