// The quality of elements, against shapes whose angles and ratios are known.
#include "sim/mechanics/element_quality.h"

#include "sim/base/math.h"
#include "sim/mesh/bar.h"
#include "sim/mesh/cells.h"
#include "sim/mesh/polygons.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rend::element_quality_test {
namespace {

const double root2 = std::sqrt(2.0), root3 = std::sqrt(3.0);

double degrees(double radians) {
  return radians * 180 / pi;
}

std::unique_ptr<EmbeddedMap> one_cell(CellKind kind, const std::vector<Vec3>& points) {
  CellMesh mesh;
  mesh.points = points;
  std::vector<std::uint32_t> corners;
  for (std::uint32_t n = 0; n < points.size(); ++n) corners.push_back(n);
  mesh.add(kind, std::span<const std::uint32_t>(corners));
  return solid_from(mesh);
}

ElementQuality of_cell(CellKind kind, const std::vector<Vec3>& points) {
  return quality_of(*one_cell(kind, points), Dart{0u});
}

std::unique_ptr<EmbeddedMap> one_polygon(const std::vector<Vec3>& points) {
  PolygonMesh mesh;
  mesh.points = points;
  for (std::uint32_t n = 0; n < points.size(); ++n) mesh.corners.push_back(n);
  mesh.first = {0, static_cast<std::uint32_t>(points.size())};
  return sheet_from(mesh);
}

ElementQuality of_polygon(const std::vector<Vec3>& points) {
  return quality_of(*one_polygon(points), Dart{0u});
}

const std::vector<Vec3> regular_tetrahedron{{1, 1, 1}, {-1, -1, 1}, {1, -1, -1}, {-1, 1, -1}};
const std::vector<Vec3> unit_cube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

TEST(ElementQuality, of_a_regular_tetrahedron) {
  const ElementQuality q = of_cell(CellKind::Tetrahedron, regular_tetrahedron);
  EXPECT_NEAR(q.least_angle, 70.528779365509, 1e-10);
  EXPECT_NEAR(q.greatest_angle, 70.528779365509, 1e-10);
  EXPECT_NEAR(q.aspect, 1, 1e-12);
  EXPECT_NEAR(q.size, 8.0 / 3, 1e-12);
}

// Four points around a circle of radius 1, at the heights ±h. Seen along the side 01, the points 2 and 3 lie at
// (±1, −2h) from it. At the side 02 the normals of its faces are along (0, 2h, 1) and (2h, 0, −1).
TEST(ElementQuality, of_a_sliver) {
  for (double h : {0.5, 0.1, 1e-3}) {
    const ElementQuality q = of_cell(CellKind::Tetrahedron, {{1, 0, h}, {-1, 0, h}, {0, 1, -h}, {0, -1, -h}});
    EXPECT_NEAR(q.greatest_angle, degrees(2 * std::atan(1 / (2 * h))), 1e-9) << "at the two long sides";
    EXPECT_NEAR(q.least_angle, degrees(std::acos(1 / (1 + 4 * h * h))), 1e-9) << "at the four others";
    const double volume = 4 * h / 3, face = std::sqrt(1 + 4 * h * h);
    EXPECT_NEAR(q.size, volume, 1e-12);
    EXPECT_NEAR(q.aspect, 2 * 4 * face / (6 * root2 * root3 * volume), 1e-9 * q.aspect);
  }
}

TEST(ElementQuality, of_a_unit_cube_and_a_flat_one) {
  const ElementQuality cube = of_cell(CellKind::Hexahedron, unit_cube);
  EXPECT_NEAR(cube.least_angle, 90, 1e-12);
  EXPECT_NEAR(cube.greatest_angle, 90, 1e-12);
  EXPECT_NEAR(cube.aspect, 1, 1e-12);
  EXPECT_NEAR(cube.size, 1, 1e-12);
  std::vector<Vec3> flat = unit_cube;
  for (Vec3& x : flat) x.z() *= 0.1;
  const ElementQuality thin = of_cell(CellKind::Hexahedron, flat);
  EXPECT_NEAR(thin.least_angle, 90, 1e-12);
  EXPECT_NEAR(thin.aspect, (2 + 0.4) / (6 * 0.1), 1e-12);
}

TEST(ElementQuality, of_a_leaning_hexahedron) {
  std::vector<Vec3> leaning = unit_cube;
  for (std::size_t n = 4; n < 8; ++n) leaning[n].x() += 1;
  const ElementQuality q = of_cell(CellKind::Hexahedron, leaning);
  EXPECT_NEAR(q.least_angle, 45, 1e-12);
  EXPECT_NEAR(q.greatest_angle, 135, 1e-12);
}

TEST(ElementQuality, of_a_prism_and_a_pyramid_with_equal_sides) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0.5, root3 / 2, 0), up(0, 0, 1);
  const ElementQuality prism = of_cell(CellKind::Prism, {a, b, c, a + up, b + up, c + up});
  EXPECT_NEAR(prism.least_angle, 60, 1e-12);
  EXPECT_NEAR(prism.greatest_angle, 90, 1e-12);
  EXPECT_NEAR(prism.aspect, 1, 1e-12);
  const ElementQuality pyramid =
      of_cell(CellKind::Pyramid, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1 / root2}});
  EXPECT_NEAR(pyramid.least_angle, degrees(std::atan(root2)), 1e-10);
  EXPECT_NEAR(pyramid.greatest_angle, degrees(std::acos(-1.0 / 3)), 1e-10);
  EXPECT_NEAR(pyramid.aspect, 1, 1e-12);
}

TEST(ElementQuality, of_triangles_and_quads) {
  const ElementQuality even = of_polygon({{0, 0, 0}, {1, 0, 0}, {0.5, root3 / 2, 0}});
  EXPECT_NEAR(even.least_angle, 60, 1e-12);
  EXPECT_NEAR(even.greatest_angle, 60, 1e-12);
  EXPECT_NEAR(even.aspect, 1, 1e-12);
  const ElementQuality right = of_polygon({{0, 0, 0}, {4, 0, 0}, {0, 3, 0}});
  EXPECT_NEAR(right.greatest_angle, 90, 1e-12);
  EXPECT_NEAR(right.least_angle, degrees(std::atan(0.75)), 1e-12);
  EXPECT_NEAR(right.aspect, 5 * 12 / (4 * root3 * 6), 1e-12);
  const ElementQuality square = of_polygon({{0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}});
  EXPECT_NEAR(square.least_angle, 90, 1e-12);
  EXPECT_NEAR(square.aspect, 1, 1e-12);
  const ElementQuality leaning = of_polygon({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {1, 1, 0}});
  EXPECT_NEAR(leaning.least_angle, 45, 1e-12);
  EXPECT_NEAR(leaning.greatest_angle, 135, 1e-12);
}

TEST(ElementQuality, does_not_depend_on_size_and_place) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vec3> points{{0, 0, 0}, {1, 0.2, 0}, {0.3, 1.1, 0.1}, {0.2, 0.3, 0.4}};
  const ElementQuality here = of_cell(CellKind::Tetrahedron, points);
  for (Vec3& x : points) x = 1e-3 * (turn * x) + Vec3(5, -4, 3);
  const ElementQuality there = of_cell(CellKind::Tetrahedron, points);
  EXPECT_NEAR(there.least_angle, here.least_angle, 1e-8);
  EXPECT_NEAR(there.greatest_angle, here.greatest_angle, 1e-8);
  EXPECT_NEAR(there.aspect, here.aspect, 1e-8);
}

TEST(MeshQuality, names_the_worst_elements_with_their_places) {
  CellMesh mesh = bar_cells({BarPattern::Hexahedra, 5, 1, 1, Vec3(5, 1, 1)});
  for (Vec3& x : mesh.points)
    if (x.x() > 2.5 && x.x() < 3.5) x.x() = 2.1; // the third cell is thin, and the fourth thick
  const auto map = solid_from(mesh);
  const MeshQuality q = mesh_quality(*map);
  EXPECT_NEAR(q.smallest.value, 0.1, 1e-12);
  EXPECT_LT((q.smallest.centre - Vec3(2.05, 0.5, 0.5)).norm(), 1e-12);
  EXPECT_EQ(q.smallest.kind, "hexahedron");
  EXPECT_EQ(q.smallest.element, 2u);
  EXPECT_NEAR(q.largest.value, 1.9, 1e-12);
  EXPECT_LT((q.largest.centre - Vec3(3.05, 0.5, 0.5)).norm(), 1e-12);
  EXPECT_NEAR(q.aspect.value, (2 + 0.4) / (6 * 0.1), 1e-10);
  EXPECT_EQ(q.aspect.element, q.smallest.element);
  EXPECT_NEAR(q.least_angle.value, 90, 1e-10);
  EXPECT_NEAR(q.greatest_angle.value, 90, 1e-10);
}

} // namespace
} // namespace rend::element_quality_test
