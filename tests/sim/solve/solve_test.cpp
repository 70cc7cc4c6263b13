// Direct and iterative solvers against each other, against dense matrices, and for several numbers of threads.
#include "sim/solve/linear_solver.h"
#include "sim/solve/vertex_order.h"

#include "sim/random_meshes.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <random>

namespace rend::solve_test {
namespace {

// A grid of n × n × n vertices, each coupled to 26 others by random symmetric blocks, with a dominant diagonal.
struct Lattice {
  BlockMatrix matrix;

  explicit Lattice(std::uint32_t n, double ruling = 1, int parts = 1) {
    std::vector<std::uint32_t> starts{0}, neighbours;
    each(
        n, [&](std::uint32_t, std::uint32_t other) { neighbours.push_back(other); },
        [&] { starts.push_back(static_cast<std::uint32_t>(neighbours.size())); });
    BlockPattern pattern = BlockPattern::of(starts, neighbours);
    pattern.parts = parts;
    matrix.reset(std::make_shared<const BlockPattern>(std::move(pattern)));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    const BlockPattern& p = *matrix.pattern();
    for (std::uint32_t i = 0; i < p.rows(); ++i)
      for (std::size_t at = p.start[i]; at < p.diagonal[i]; ++at) {
        Eigen::Matrix3d b;
        for (int k = 0; k < 9; ++k) b(k) = any(random);
        // as for a spring between i and j: positive semidefinite in total
        const Eigen::Matrix3d spring = b * b.transpose();
        add(i, i, spring);
        add(p.column[at], p.column[at], spring);
        add(i, p.column[at], -spring);
        add(p.column[at], i, -spring);
      }
    for (std::uint32_t i = 0; i < p.rows(); ++i) matrix.add_diagonal(i, ruling);
  }

  void add(std::uint32_t i, std::uint32_t j, const Eigen::Matrix3d& b) {
    Block3& to = matrix.at(matrix.pattern()->place(i, j));
    to = Block3::of(to.matrix() + b);
  }

  template <class F, class G> static void each(std::uint32_t n, F&& join, G&& next) {
    const auto m = static_cast<int>(n);
    for (int k = 0; k < m * m * m; ++k) {
      const int x = k % m, y = k / m % m, z = k / m / m;
      for (int d = 0; d < 27; ++d) {
        const int a = x + d % 3 - 1, b = y + d / 3 % 3 - 1, c = z + d / 9 - 1;
        if (std::min({a, b, c}) >= 0 && std::max({a, b, c}) < m)
          join(static_cast<std::uint32_t>(k), static_cast<std::uint32_t>((c * m + b) * m + a));
      }
      next();
    }
  }
};

Eigen::MatrixXd dense(const BlockMatrix& m) {
  Eigen::MatrixXd all =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * m.rows()), static_cast<Eigen::Index>(3 * m.rows()));
  const BlockPattern& p = *m.pattern();
  for (std::size_t i = 0; i < p.rows(); ++i)
    for (std::size_t at = p.start[i]; at < p.start[i + 1]; ++at)
      all.block<3, 3>(static_cast<Eigen::Index>(3 * i), 3 * static_cast<Eigen::Index>(p.column[at])) =
          m.at(at).matrix();
  return all;
}

Eigen::VectorXd flat(const Records& r) {
  Eigen::VectorXd all(static_cast<Eigen::Index>(3 * r.size()));
  for (std::size_t i = 0; i < r.size(); ++i) all.segment<3>(static_cast<Eigen::Index>(3 * i)) = r[i].vec();
  return all;
}

Records right_side(std::size_t rows) {
  Records b(rows);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (Record& r : b) r = Record(any(random), any(random), any(random));
  return b;
}

TEST(BlockMatrix, multiplies_as_a_dense_one) {
  const Lattice l(4);
  const Records b = right_side(64);
  Records y(64);
  l.matrix.multiply(b.data(), y.data());
  EXPECT_LT((dense(l.matrix) * flat(b) - flat(y)).norm(), 1e-12 * flat(y).norm());
  for (const Record& r : y) EXPECT_EQ(r.w, 0);
}

TEST(BlockFactor, solves_as_a_dense_one) {
  const Lattice l(4);
  const Records b = right_side(64);
  Records x(64);
  BlockFactor factor;
  factor.analyse(l.matrix.pattern());
  EXPECT_EQ(factor.factorise(l.matrix), Definiteness::Positive);
  factor.solve(b.data(), x.data());
  const Eigen::VectorXd right = dense(l.matrix).ldlt().solve(flat(b));
  EXPECT_LT((right - flat(x)).norm(), 1e-12 * right.norm());
  factor.solve(x.data(), x.data());
  const Eigen::VectorXd twice = dense(l.matrix).ldlt().solve(right);
  EXPECT_LT((twice - flat(x)).norm(), 1e-11 * twice.norm());
}

TEST(BlockFactor, tells_what_kind_of_matrix_it_is) {
  BlockFactor factor;
  Lattice free(3, 0); // can translate along three axes
  factor.analyse(free.matrix.pattern());
  EXPECT_EQ(factor.factorise(free.matrix), Definiteness::Singular);
  free.matrix.add_diagonal(5, 1);
  EXPECT_EQ(factor.factorise(free.matrix), Definiteness::Positive);
  free.matrix.add_diagonal(5, -1.5);
  EXPECT_EQ(factor.factorise(free.matrix), Definiteness::Indefinite);
}

TEST(BlockMatrix, holds_coordinates) {
  Lattice l(3);
  const Eigen::MatrixXd whole = dense(l.matrix);
  std::vector<std::uint8_t> axes(27, 0);
  axes[4] = 7;
  axes[9] = 2;
  l.matrix.constrain(axes.data());
  const Eigen::MatrixXd held = dense(l.matrix);
  for (int r = 0; r < 81; ++r)
    for (int c = 0; c < 81; ++c) {
      const auto fixed = [&](int k) { return (axes[static_cast<std::size_t>(k / 3)] >> (k % 3) & 1) != 0; };
      EXPECT_EQ(held(r, c), fixed(r) || fixed(c) ? (r == c ? 1 : 0) : whole(r, c)) << r << " " << c;
    }
}

TEST(ConjugateGradient, agrees_with_the_direct_solver) {
  const Lattice l(12, 0.01);
  const Records b = right_side(l.matrix.rows());
  Records direct(b.size()), iterated;
  BlockFactor factor;
  factor.analyse(l.matrix.pattern());
  ASSERT_EQ(factor.factorise(l.matrix), Definiteness::Positive);
  factor.solve(b.data(), direct.data());
  Preconditioner preconditioner;
  ASSERT_TRUE(preconditioner.set_matrix(l.matrix, Precision::Double));
  ConjugateGradient gradient;
  const auto result = gradient.solve(preconditioner, 1, b, iterated, 1e-12, 2000);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(result.iterations, 200);
  EXPECT_LT((flat(direct) - flat(iterated)).norm(), 1e-9 * flat(direct).norm());
}

TEST(ConjugateGradient, gives_the_same_bytes_on_any_number_of_threads) {
  std::vector<Records> all;
  for (const int parts : {1, 2, 4}) {
    const Lattice l(18, 0.1, parts); // more rows than one range of the preconditioner
    const Records b = right_side(l.matrix.rows());
    Preconditioner preconditioner;
    ASSERT_TRUE(preconditioner.set_matrix(l.matrix, Precision::Double));
    all.emplace_back();
    ConjugateGradient().solve(preconditioner, parts, b, all.back(), 1e-8, 500);
  }
  for (const Records& x : all) EXPECT_EQ(std::memcmp(x.data(), all[0].data(), x.size() * sizeof(Record)), 0);
}

TEST(Preconditioner, multiplies_with_the_matrix_between_its_halves) {
  const Lattice l(17, 0.5); // more rows than one range
  const std::size_t rows = l.matrix.rows();
  for (const Precision precision : {Precision::Double, Precision::Single}) {
    Preconditioner m;
    ASSERT_TRUE(m.set_matrix(l.matrix, precision));
    const Records p = right_side(rows);
    Records t(rows), image(rows), natural(rows), product(rows), expected(rows);
    m.product(p, t, image);
    for (std::size_t k = 0; k < rows; ++k) natural[m.order()[k]] = t[k];
    l.matrix.multiply(natural.data(), product.data());
    for (std::size_t k = 0; k < rows; ++k) expected[k] = product[m.order()[k]];
    m.forward(expected, expected);
    const double error = (flat(expected) - flat(image)).norm() / flat(image).norm();
    EXPECT_LT(error, precision == Precision::Double ? 1e-13 : 1e-6);
  }
}

TEST(Preconditioner, refuses_a_diagonal_that_is_not_positive) {
  Lattice l(3);
  Preconditioner m;
  EXPECT_TRUE(m.set_matrix(l.matrix, Precision::Single));
  l.matrix.add_diagonal(13, -1000);
  EXPECT_FALSE(m.set_matrix(l.matrix, Precision::Single));
}

TEST(VertexOrder, is_a_permutation_that_brings_neighbours_together) {
  // A path graph with shuffled rows, and an isolated row.
  const std::uint32_t n = 101;
  std::vector<std::vector<std::uint32_t>> beside(n + 1);
  const auto name = [&](std::uint32_t k) { return k * 37 % n; };
  for (std::uint32_t k = 0; k + 1 < n; ++k) {
    beside[name(k)].push_back(name(k + 1));
    beside[name(k + 1)].push_back(name(k));
  }
  std::vector<std::uint32_t> starts{0}, neighbours;
  for (const auto& row : beside) {
    neighbours.insert(neighbours.end(), row.begin(), row.end());
    starts.push_back(static_cast<std::uint32_t>(neighbours.size()));
  }
  const std::vector<std::uint32_t> order = vertex_order(BlockPattern::of(starts, neighbours));
  std::vector<std::uint32_t> place(n + 1, n + 1);
  ASSERT_EQ(order.size(), n + 1);
  for (std::uint32_t k = 0; k <= n; ++k) place[order[k]] = k;
  for (std::uint32_t i = 0; i <= n; ++i) ASSERT_LE(place[i], n);
  for (std::uint32_t k = 0; k + 1 < n; ++k)
    EXPECT_EQ(std::max(place[name(k)], place[name(k + 1)]) - std::min(place[name(k)], place[name(k + 1)]), 1u);
}

TEST(LinearSolver, iterates_or_not_by_a_rule) {
  const Lattice small(3), large(14, 10);
  for (const Lattice* l : {&small, &large}) {
    LinearSolver solver;
    solver.set_matrix(l->matrix);
    const Records b = right_side(l->matrix.rows());
    Records x, y(b.size());
    ASSERT_TRUE(solver.solve(b, x, 1e-8));
    EXPECT_EQ(solver.factorisations(), l == &small);
    EXPECT_EQ(solver.iterations() > 0, l == &large);
    l->matrix.multiply(x.data(), y.data());
    EXPECT_LT((flat(b) - flat(y)).norm(), 2e-8 * flat(b).norm());
  }
}

TEST(LinearSolver, says_that_a_singular_matrix_is_not_solved) {
  const Lattice l(3, 0);
  LinearSolver solver;
  solver.set_matrix(l.matrix);
  Records x;
  EXPECT_FALSE(solver.solve(right_side(27), x, 1e-8));
}

} // namespace
} // namespace rend::solve_test
