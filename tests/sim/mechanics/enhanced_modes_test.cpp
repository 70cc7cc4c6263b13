// Enhanced quads and hexahedra against the answers of MacNeal and Harder (1985) and Cook (1974), and the
// elastica; and that a uniform strain does not see the modes.
#include "sim/elements.h"
#include "sim/presets.h"

#include <Eigen/SparseCholesky>
#include <functional>
#include <gtest/gtest.h>

namespace rend::enhanced_modes_test {
namespace {

using namespace elements;

// Bricks, or quads in the plane of x and z (one layer of points along y).
struct Grid {
  int nx, ny, nz; // cells; ny = 0: quads
  std::vector<Vec3> points;
  std::size_t at(int i, int j, int k) const {
    return static_cast<std::size_t>((k * (ny + 1) + j) * (nx + 1) + i);
  }
};

Grid grid(int nx, int ny, int nz, const std::function<Vec3(double, double, double)>& place) {
  Grid g{nx, ny, nz, {}};
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        g.points.push_back(place(double(i) / nx, ny == 0 ? 0 : double(j) / ny, double(k) / nz));
  return g;
}

struct Problem {
  Grid mesh;
  Formulation formulation;
  double young, poisson;
  std::function<bool(const Vec3& x, int axis)> fixed;
  std::function<Vec3(const Vec3& x)> force; // [N] on a point
};

std::vector<std::vector<std::size_t>> cells_of(const Grid& g) {
  std::vector<std::vector<std::size_t>> cells;
  for (int k = 0; k < g.nz; ++k)
    for (int i = 0; i < g.nx; ++i) {
      if (g.ny == 0)
        cells.push_back({g.at(i, 0, k), g.at(i + 1, 0, k), g.at(i + 1, 0, k + 1), g.at(i, 0, k + 1)});
      for (int j = 0; j < g.ny; ++j)
        cells.push_back({g.at(i, j, k), g.at(i + 1, j, k), g.at(i + 1, j + 1, k), g.at(i, j + 1, k),
                         g.at(i, j, k + 1), g.at(i + 1, j, k + 1), g.at(i + 1, j + 1, k + 1),
                         g.at(i, j + 1, k + 1)});
    }
  return cells;
}

// Displacements of small-strain elements, of thickness 0.1 if they are quads.
std::vector<Vec3> solved(const Problem& p) {
  const auto size = static_cast<Eigen::Index>(3 * p.mesh.points.size());
  std::vector<Eigen::Triplet<double>> entries;
  const Model model{"", ElasticModel::Linear, Rotation::Polar, p.formulation};
  const auto free = [&](std::size_t n, int axis) { return !p.fixed(p.mesh.points[n], axis); };
  for (const auto& cell : cells_of(p.mesh)) {
    std::vector<Vec3> corners;
    for (std::size_t n : cell) corners.push_back(p.mesh.points[n]);
    const Element e(p.mesh.ny == 0 ? ElementKind::Quad : ElementKind::Hexahedron, model, corners, 0, p.poisson);
    UnitMatrix K, by_velocity;
    e.law->stiffness(e.unit.data(), e.state(), Tangent::Exact, K, by_velocity);
    for (std::size_t a = 0; a < cell.size(); ++a)
      for (std::size_t b = 0; b < cell.size(); ++b)
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c)
            if (free(cell[a], r) && free(cell[b], c))
              entries.emplace_back(3 * cell[a] + r, 3 * cell[b] + c, p.young / 100 * K(3 * a + r, 3 * b + c));
  }
  Eigen::VectorXd f = Eigen::VectorXd::Zero(size);
  for (std::size_t n = 0; n < p.mesh.points.size(); ++n)
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<Eigen::Index>(3 * n) + axis;
      if (free(n, axis))
        f[at] = p.force(p.mesh.points[n])[axis];
      else
        entries.emplace_back(at, at, 1);
    }
  Eigen::SparseMatrix<double> K(size, size);
  K.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd u = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(K).solve(f);
  std::vector<Vec3> moved;
  for (std::size_t n = 0; n < p.mesh.points.size(); ++n)
    moved.push_back(u.segment<3>(static_cast<Eigen::Index>(3 * n)));
  return moved;
}

enum class Slant { None, Parallel, Alternating };

// The straight beam: 6 × 0.1 × 0.2 m of six elements; inner lines slanted by 45°.
Grid beam(Slant slant, bool quads) {
  return grid(6, quads ? 0 : 1, 1, [=](double x, double y, double z) {
    const int line = static_cast<int>(std::lround(6 * x));
    const double sign = slant == Slant::None || line == 0 || line == 6 ? 0
                        : slant == Slant::Alternating && line % 2 == 0 ? -1
                                                                       : 1;
    return Vec3(6 * x + sign * 0.2 * (z - 0.5), 0.1 * y - 0.05, 0.2 * z - 0.1);
  });
}

// What the end moves under a load in each direction, over the theory's; turned: about the axis.
double share(Slant slant, const Vec3& force, bool turned, double theory, Formulation formulation,
             bool quads = false) {
  const Grid mesh = beam(slant, quads);
  const auto end = [](const Vec3& x) { return x.x() > 6 - 1e-9; };
  const auto arm = [](const Vec3& x) { return Vec3(0, -x.z(), x.y()); };
  int ends = 0;
  double square = 0;
  for (const Vec3& x : mesh.points)
    if (end(x)) ++ends, square += arm(x).squaredNorm();
  const std::vector<Vec3> u =
      solved({mesh, formulation, 1e7, 0.3,
              [&](const Vec3& x, int axis) { return x.x() < 1e-9 || (quads && axis == 1); },
              [&](const Vec3& x) {
                return !end(x) ? Vec3(0, 0, 0) : turned ? Vec3(arm(x) / square) : Vec3(force / ends);
              }});
  double moved = 0;
  for (std::size_t n = 0; n < u.size(); ++n)
    if (end(mesh.points[n])) moved += turned ? arm(mesh.points[n]).dot(u[n]) / square : force.dot(u[n]) / ends;
  return moved / theory;
}

TEST(EnhancedModes, bend_the_straight_beam_of_macneal_and_harder) {
  const Vec3 in_plane(0, 0, 1), out_of_plane(0, 1, 0), none(0, 0, 0);
  const auto enhanced = Formulation::Enhanced, plain = Formulation::Plain;
  EXPECT_NEAR(share(Slant::None, in_plane, false, 0.1081, plain), 0.0929,
              1e-3); // a second program of plain ones
  EXPECT_GT(share(Slant::None, in_plane, false, 0.1081, enhanced), 0.97);
  EXPECT_GT(share(Slant::None, out_of_plane, false, 0.4321, enhanced), 0.97);
  EXPECT_GT(share(Slant::None, none, true, 0.03208, enhanced), 0.89);
  EXPECT_GT(share(Slant::Parallel, in_plane, false, 0.1081, enhanced), 0.62);
  EXPECT_GT(share(Slant::Alternating, in_plane, false, 0.1081, enhanced),
            0.047); // MacNeal: no more than 0.05 or so
  for (Slant slant : {Slant::None, Slant::Parallel, Slant::Alternating}) {
    const double of_quads = share(slant, in_plane, false, 0.1081, enhanced, true);
    EXPECT_GT(of_quads, slant == Slant::None ? 0.97 : slant == Slant::Parallel ? 0.62 : 0.05);
  }
}

// Plane strain, nearly incompressible: 18.51 m at the middle of the right side.
TEST(EnhancedModes, do_not_lock_in_cooks_membrane) {
  const int n = 32;
  const Grid mesh = grid(n, 1, n, [](double x, double y, double z) {
    const double low = 44 * x, high = 44 + 16 * x;
    return Vec3(48 * x, y, low + (high - low) * z);
  });
  const auto u = solved({mesh, Formulation::Enhanced, 1, 0.4999,
                         [](const Vec3& x, int axis) { return x.x() < 1e-9 || axis == 1; },
                         [](const Vec3& x) {
                           if (x.x() < 48 - 1e-9) return Vec3(0, 0, 0);
                           const bool corner = x.z() < 44 + 1e-9 || x.z() > 60 - 1e-9;
                           return Vec3(0, 0, (corner ? 0.5 : 1) / n / 2);
                         }});
  const double moved = u[mesh.at(n, 0, n / 2)].z();
  EXPECT_GT(moved / 18.51, 0.99);
  EXPECT_LT(moved / 18.51, 1.01);
}

// A deformation x = A r of all corners: F = A at every point, and the modes have nothing to add.
TEST(EnhancedModes, are_not_excited_by_a_uniform_strain) {
  for (ElementKind kind : {ElementKind::Quad, ElementKind::Hexahedron}) {
    for (std::size_t model = 0; model < 3; ++model) {
      for (unsigned seed = 1; seed < 6; ++seed) {
        const std::vector<Vec3> rest = distorted(kind, 0.2, seed);
        Element plain(kind, every_model()[model], rest), enhanced(kind, every_model()[model + 3], rest);
        ASSERT_EQ(enhanced.law->formulation(), Formulation::Enhanced);
        Noise noise(seed);
        Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
        for (int r = 0; r < 3; ++r) A.row(r) += 0.2 * noise.vector().transpose();
        for (std::size_t n = 0; n < rest.size(); ++n) plain.x[n] = enhanced.x[n] = A * rest[n];
        const auto f = plain.forces(), g = enhanced.forces();
        for (std::size_t n = 0; n < rest.size(); ++n) EXPECT_LT((f[n] - g[n]).norm(), 1e-12 * largest(f));
      }
    }
  }
}

// E I θ'' = −P cos θ: answers by shooting (verify/elastica-1, elastica-5), here with a fifth of its cells.
TEST(EnhancedModes, bend_the_elastica) {
  struct Bent {
    const char* force;
    double x, z;
  };
  for (const Bent& bent : {Bent{"-2.1333333333333333", -0.056433, -0.301721}}) {
    const auto s = presets::load(
        std::string(R"(<scene><body><bar cells="40 1 1" size="1 0.04 0.04"/><mass density="1000"/>)") +
        R"(<elasticity young="1e7" poisson="0" formulation="enhanced"/><fix side="-x"/>)" +
        R"(<load side="+x" force="0 0 )" + bent.force +
        R"("/><probe name="tip" side="+x"/></body><world gravity="0 0 0"/>)" +
        R"(<time step="1" integrator="static" duration="1"/></scene>)");
    s->step();
    const Vec3 moved = s.body().probes[0].read(s.body())->displacement;
    EXPECT_NEAR(moved.x() / bent.x, 1, 5e-3);
    EXPECT_NEAR(moved.z() / bent.z, 1, 5e-3);
  }
}

} // namespace
} // namespace rend::enhanced_modes_test
