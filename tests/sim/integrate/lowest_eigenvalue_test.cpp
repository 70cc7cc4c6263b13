// The smallest eigenvalue of a non-symmetric tangent, against all eigenvalues of a dense matrix from
// differences of forces.
#include "sim/integrate/lowest_eigenvalue.h"

#include "sim/presets.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace rend::lowest_eigenvalue_test {
namespace {

// −M⁻¹ ∂f/∂x at the free coordinates, by central differences.
Eigen::MatrixXd dense(const Equilibrium& at) {
  std::vector<std::pair<std::size_t, int>> free;
  for (std::size_t i = 0; i < at.position.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (!(at.held[i] >> axis & 1)) free.push_back({i, axis});
  const auto count = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd out(count, count);
  constexpr double h = 1e-6;
  for (Eigen::Index column = 0; column < count; ++column) {
    const auto [vertex, axis] = free[static_cast<std::size_t>(column)];
    Records force[2];
    for (const int side : {0, 1}) {
      Records x = at.position;
      Vec3 moved = x[vertex];
      moved[axis] += side == 0 ? h : -h;
      x[vertex] = moved;
      force[side].resize(x.size());
      at.system.forces(at.time, x.data(), at.still.data(), force[side].data());
    }
    for (Eigen::Index row = 0; row < count; ++row) {
      const auto [i, along] = free[static_cast<std::size_t>(row)];
      out(row, column) =
          at.system.inverse_mass[i] * (force[1][i].vec()[along] - force[0][i].vec()[along]) / (2 * h);
    }
  }
  return out;
}

// A short, nearly incompressible bar, clamped at one end, bent and twisted.
TEST(LeastResistance, is_the_least_of_all_eigenvalues) {
  int below = 0, above = 0;
  for (const double bent : {0.0, 0.02, 0.05, 0.1, 0.2, 0.3}) {
    for (const double pressed : {0.0, 1e-4, 0.01, 0.03}) {
      const auto s = presets::load(
          R"(<scene><body><bar pattern="hexahedra" cells="4 1 1" size="1 0.3 0.3"/><mass density="1000"/>)"
          R"(<elasticity young="1e5" poisson="0.499"/><fix side="-x"/></body>)"
          R"(<time step="1" integrator="static" duration="1"/></scene>)");
      Body& body = s.body();
      body.evaluate();
      Records x = body.map->position().values(), still(x.size());
      for (Record& r : x) {
        const double angle = bent * r.x, radius = r.z - 0.1;
        r = Record((1 - pressed) * r.x * std::cos(angle) + radius * std::sin(angle), r.y,
                   0.1 + radius * std::cos(angle) - 0.5 * bent * r.x * r.x);
      }
      std::vector<std::uint8_t> held(x.size(), 0);
      body.mark_prescribed(1, held.data());
      body.constrain(1, x.data(), still.data());
      const Equilibrium at{body, 1, x, still, held};
      const Eigen::VectorXcd all = dense(at).eigenvalues();
      Eigen::Index least = 0;
      all.real().minCoeff(&least);
      if (all[least].imag() != 0) continue; // inverse iteration with a real shift cannot find a complex pair
      BlockMatrix matrix;
      LinearSolver linear;
      LoadTangent tangent;
      const double found = lowest_eigenvalue(at, matrix, linear, tangent), should = all[least].real();
      EXPECT_NEAR(found, should, 0.02 * std::abs(should)) << bent << " " << pressed;
      (should < 0 ? below : above) += 1;
    }
  }
  EXPECT_GT(below, 2);
  EXPECT_GT(above, 2);
}

} // namespace
} // namespace rend::lowest_eigenvalue_test
