// Masses against sums over polygons and over particles.
#include "sim/mechanics/mass.h"

#include "sim/house_rules/house_rules.h"
#include "sim/mesh/bar.h"
#include "sim/mesh/tube.h"
#include "sim/random_meshes.h"
#include "sim/rules/apply.h"

#include <gtest/gtest.h>

namespace rend::mass_test {
namespace {

using namespace meshes;

double flat_area_of(const PolygonMesh& mesh) { // of flat polygons
  double area = 0;
  for (std::size_t p = 0; p < mesh.polygons(); ++p) {
    Vec3 sum = Vec3::Zero();
    for (std::uint32_t n = mesh.first[p]; n < mesh.first[p + 1]; ++n) {
      const std::uint32_t next = n + 1 < mesh.first[p + 1] ? n + 1 : mesh.first[p];
      sum += mesh.points[mesh.corners[n]].cross(mesh.points[mesh.corners[next]]);
    }
    area += 0.5 * sum.norm();
  }
  return area;
}

PolygonMesh flat(SheetPattern pattern, unsigned seed) {
  PolygonMesh mesh = warped(sheet(pattern, 5, 4), 0.2, seed);
  for (Vec3& x : mesh.points) x.z() = 0;
  return mesh;
}

TEST(Mass, of_all_corners_is_the_density_times_the_area) {
  for (auto pattern :
       {SheetPattern::Quads, SheetPattern::Triangles, SheetPattern::Crossed, SheetPattern::Mixed}) {
    const PolygonMesh mesh = flat(pattern, 3);
    const auto body = meshes::body(mesh);
    EXPECT_NEAR(total_mass(*body->map, *body->mass), 0.1 * flat_area_of(mesh), 1e-14);
  }
}

TEST(Mass, of_a_vertex_is_the_sum_of_its_corners) {
  for (const Named& each : irregular()) {
    const auto body = meshes::body(each.mesh);
    std::vector<double> sum(body->program->vertices(), 0);
    const CellIndex& corners = body->map->cells(VertexOfFace);
    for (Slot c = 0; c < corners.slots(); ++c)
      sum[body->map->vertex(corners.first_dart(c))] += (*body->mass)[c];
    double total = 0;
    for (Slot v = 0; v < sum.size(); ++v) {
      EXPECT_NEAR(1 / body->program->inverse_mass()[v], sum[v], 1e-15 * sum[v] * 10);
      total += sum[v];
    }
    EXPECT_NEAR(total, total_mass(*body->map, *body->mass), 1e-13);
  }
}

TEST(Mass, momenta_and_energy_are_those_of_the_particles) {
  const auto body = meshes::body(irregular()[3].mesh);
  shake(*body, 0.1, 5);
  Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
  double kinetic = 0, gravity = 0;
  const Vec3 g(0, 1, -9.81);
  for (Slot v = 0; v < body->program->vertices(); ++v) {
    const double m = 1 / body->program->inverse_mass()[v];
    const Vec3 x = positions(*body)[v], u = velocities(*body)[v];
    momentum += m * u;
    angular += m * x.cross(u);
    kinetic += 0.5 * m * u.squaredNorm();
    gravity -= m * g.dot(x);
  }
  EXPECT_LT((total_momentum(*body->map, *body->mass) - momentum).norm(), 1e-13);
  EXPECT_LT((total_angular_momentum(*body->map, *body->mass) - angular).norm(), 1e-13);
  EXPECT_NEAR(kinetic_energy(*body->map, *body->mass), kinetic, 1e-13);
  EXPECT_NEAR(gravity_energy(*body->map, *body->mass, g), gravity, 1e-12);
}

TEST(Mass, of_flat_irregular_sheets_is_conserved_by_subdivision) {
  for (auto pattern :
       {SheetPattern::Quads, SheetPattern::Triangles, SheetPattern::Crossed, SheetPattern::Mixed}) {
    const auto body = meshes::body(flat(pattern, 6));
    const double before = total_mass(*body->map, *body->mass);
    for (int times = 0; times < 2; ++times) {
      ASSERT_TRUE(apply(rule("quarter-faces"), *body->map, Dart{0u}).ok);
      EXPECT_NEAR(total_mass(*body->map, *body->mass), before, 1e-14 * before);
    }
  }
}

// Affine maps keep faces flat: volumes then have a closed form.
CellMesh sheared(CellMesh mesh) {
  for (Vec3& x : mesh.points) x = Vec3(x.x() + 0.3 * x.y(), x.y() - 0.2 * x.z(), x.z() + 0.1 * x.x());
  return mesh;
}

TEST(MassOfSolids, is_the_density_times_the_volume_and_each_corner_has_its_share) {
  Eigen::Matrix3d shear;
  shear << 1, 0.3, 0, 0, 1, -0.2, 0.1, 0, 1;
  for (auto pattern : {BarPattern::Hexahedra, BarPattern::Tetrahedra, BarPattern::Prisms, BarPattern::Mixed}) {
    const CellMesh mesh = sheared(bar_cells({pattern, 4, 2, 3, Vec3(2, 1, 1.5)}));
    const auto map = solid_from(mesh);
    const auto& mass = map->add(CornerMass{.density = 1000}.on(*map));
    EXPECT_NEAR(total_mass(*map, mass), 3000 * shear.determinant(), 1e-10);
    std::uint32_t dart = 0;
    for (std::size_t c = 0; c < mesh.cells(); ++c) {
      const CellShape& shape = shape_of(mesh.kinds[c]);
      const double share = 1000 * signed_volume(mesh, c) / shape.corners;
      for (int n = 0; n < shape.darts; ++n, ++dart)
        EXPECT_NEAR(mass[map->slot(VertexOfVolume, Dart{dart})], share, 1e-12 * share);
    }
  }
}

TEST(MassOfSolids, keeps_its_last_bit_when_all_elements_part) {
  const auto map = solid_from(tube_cells({8, 4, Vec3(1, 0.8, 3), 0.15}));
  const auto& mass = map->add(CornerMass{.density = 1000}.on(*map));
  const double before = total_mass(*map, mass);
  map->edit([&](Edit& edit) { map->map().for_each_dart([&](Dart d) { unsew(edit, 3, d); }); });
  EXPECT_EQ(total_mass(*map, mass), before);
  EXPECT_EQ(map->cells(Vertex).count(), 32u * 8u);
}

TEST(MassOfSolids, drag_is_shared_by_the_corners_of_a_vertex) {
  const auto map = solid_from(bar_cells({BarPattern::Mixed, 3, 2, 2, Vec3(1, 1, 1)}));
  const auto& drag = map->add(CornerDrag{.per_vertex = 0.5}.on(*map));
  map->map().for_each_dart(
      [&](Dart d) { EXPECT_NEAR(sum_at_vertex(*map, drag.orbit(), drag.values(), d), 0.5, 1e-14); });
}

} // namespace
} // namespace rend::mass_test
