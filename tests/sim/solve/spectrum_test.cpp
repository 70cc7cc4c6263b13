#include "sim/solve/spectrum.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <gtest/gtest.h>

namespace rend::spectrum_test {
namespace {

constexpr double half_turn = 3.14159265358979323846;

// A matrix on a chain of `count` vertices, each coupled to its neighbours by a block.
BlockMatrix chain(std::size_t count) {
  std::vector<std::uint32_t> starts{0}, neighbours;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) neighbours.push_back(static_cast<std::uint32_t>(i - 1));
    if (i + 1 < count) neighbours.push_back(static_cast<std::uint32_t>(i + 1));
    starts.push_back(static_cast<std::uint32_t>(neighbours.size()));
  }
  BlockMatrix m;
  m.reset(std::make_shared<const BlockPattern>(BlockPattern::of(starts, neighbours)));
  return m;
}

void add_unit(BlockMatrix& m, std::uint32_t i, std::uint32_t j, const Eigen::Matrix3d& k) {
  const BlockPattern& p = *m.pattern();
  for (auto [a, b, sign] : {std::tuple{i, i, 1.0}, {j, j, 1.0}, {i, j, -1.0}, {j, i, -1.0}}) {
    Block3& block = m.at(p.place(a, b));
    block = Block3::of(block.matrix() + sign * k);
  }
}

// N springs and N masses, one end fixed: ω_max = 2 √(k/m) sin((2N − 1)/(2N + 1) · π/2).
TEST(Spectrum, FindsTheHighestFrequencyOfAChain) {
  for (const std::size_t n : {1u, 2u, 7u, 40u}) {
    BlockMatrix m = chain(n + 1);
    for (std::uint32_t i = 0; i < n; ++i) add_unit(m, i, i + 1, Vec3(50, 0, 0).asDiagonal());
    std::vector<double> inverse(n + 1, 1 / 0.2);
    std::vector<std::uint8_t> held(n + 1, 0);
    held[0] = 7;
    const HighestMode mode = highest_mode(m, inverse.data(), held);
    const double count = static_cast<double>(n);
    const double known = 2 * std::sqrt(50 / 0.2) * std::sin((2 * count - 1) / (2 * count + 1) * half_turn / 2);
    EXPECT_NEAR(std::sqrt(mode.omega_squared), known, 1e-6 * known) << n;
    EXPECT_LE(mode.residual, 1e-6);
  }
}

// Different masses, full blocks, single fixed coordinates, a free slot.
TEST(Spectrum, AgreesWithAllEigenvalues) {
  const std::size_t n = 20;
  std::uint64_t seed = 5;
  BlockMatrix m = chain(n);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  std::vector<double> inverse(n);
  for (std::uint32_t i = 0; i + 1 < n; ++i) {
    const Records r = scattered(3, std::vector<double>(3, 1.0).data(), std::vector<std::uint8_t>(3, 0), seed++);
    Eigen::Matrix3d b;
    b << r[0].vec(), r[1].vec(), r[2].vec();
    add_unit(m, i, i + 1, b * b.transpose());
    const Eigen::Matrix3d k = b * b.transpose();
    for (auto [p, q, sign] : {std::tuple{i, i, 1.0}, {i + 1, i + 1, 1.0}, {i, i + 1, -1.0}, {i + 1, i, -1.0}})
      dense.block<3, 3>(3 * p, 3 * q) += sign * k;
  }
  for (std::size_t i = 0; i < n; ++i) inverse[i] = 0.1 + static_cast<double>(i * i % 7);
  inverse[n - 1] = 0;
  std::vector<std::uint8_t> held(n, 0);
  held[3] = 2;
  held[8] = 5;
  Eigen::VectorXd root(3 * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t a = 0; a < 3; ++a)
      root[static_cast<Eigen::Index>(3 * i + a)] = held[i] >> a & 1 ? 0 : std::sqrt(inverse[i]);
  const Eigen::MatrixXd scaled = root.asDiagonal() * dense * root.asDiagonal();
  const double known = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled).eigenvalues().maxCoeff();
  const HighestMode mode = highest_mode(m, inverse.data(), held);
  EXPECT_NEAR(mode.omega_squared, known, 1e-9 * known);

  // the mode has unit mass, fixed coordinates and free slots are 0, and K φ = ω² M φ
  Records image(n);
  m.multiply(mode.shape.data(), image.data());
  double mass = 0;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    mass += mode.shape[i].vec().squaredNorm() / inverse[i];
    for (std::size_t a = 0; a < 3; ++a) {
      const double x = mode.shape[i].vec()[static_cast<Eigen::Index>(a)];
      if (held[i] >> a & 1)
        EXPECT_EQ(x, 0);
      else
        EXPECT_NEAR(image[i].vec()[static_cast<Eigen::Index>(a)] * inverse[i], known * x, 1e-4 * known);
    }
  }
  EXPECT_NEAR(mass, 1, 1e-12);
  EXPECT_TRUE(mode.shape[n - 1].vec().isZero(0));
}

TEST(Spectrum, IsTheSameInEachRun) {
  BlockMatrix m = chain(9);
  for (std::uint32_t i = 0; i < 8; ++i) add_unit(m, i, i + 1, Vec3(1 + i, 2, 3).asDiagonal());
  const std::vector<double> inverse(9, 1.0);
  const std::vector<std::uint8_t> held(9, 0);
  EXPECT_EQ(highest_mode(m, inverse.data(), held).omega_squared,
            highest_mode(m, inverse.data(), held).omega_squared);
}

TEST(Spectrum, IsZeroWhereNothingCanMove) {
  BlockMatrix m = chain(3);
  add_unit(m, 0, 1, Eigen::Matrix3d::Identity());
  const std::vector<double> inverse(3, 1.0);
  EXPECT_EQ(highest_mode(m, inverse.data(), {7, 7, 7}).omega_squared, 0);
}

} // namespace
} // namespace rend::spectrum_test
