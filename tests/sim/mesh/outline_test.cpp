// Outlines against closed forms of areas, paths against the same path written otherwise, meshes against the
// outline and Euler's formula.
#include "sim/mesh/outline_mesh.h"

#include "sim/base/math.h"
#include "sim/topology/count.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <set>

namespace rend::outline_test {
namespace {

double area_of_path(const char* path) {
  return outline_of_path(path).area();
}

TEST(OutlinePath, areas_are_those_of_closed_forms) {
  EXPECT_NEAR(area_of_path("M 0 0 L 3 0 L 3 2 L 0 2 Z"), 6, 6e-3);
  EXPECT_NEAR(area_of_path("M0,0 h3 v2 h-3 z"), 6, 6e-3);
  EXPECT_NEAR(area_of_path("M 0 0 3 0 3 2 0 2"), 6, 6e-3);       // pairs after M are lines; closed
  EXPECT_NEAR(area_of_path("M 0 0 Q 1 2 2 0 Z"), 4.0 / 3, 2e-3); // a parabola of height 1
  EXPECT_NEAR(area_of_path("M 0 0 C 0 1 1 1 1 0 Z"), 0.6, 1e-3); // 3/20 of 2 · 2
  EXPECT_NEAR(area_of_path("M1,0 A1,1 0 0 1 -1,0 A1,1 0 0 1 1,0"), pi, 3e-3);
  EXPECT_NEAR(area_of_path("M0,0 a2,1 30 1 1 1e-6,0 Z"), 2 * pi, 8e-3); // an ellipse
  EXPECT_NEAR(area_of_path("M-2,0 A2,1 0 0 1 2,0 Z"), pi, 3e-3); // half of an ellipse, the x radius first
  EXPECT_NEAR(area_of_path("M0,0 A1,1 0 0 1 1,1 L0,1Z"), pi / 4, 3e-3);
}

TEST(OutlinePath, an_arc_stays_on_its_circle) {
  for (const char* path : {"M1,0 A1,1 0 0 1 0,1 Z", "M1,0 A1,1 0 1 0 0,1 Z", "M1,0 A1 1 50 0 1 0 1z"}) {
    const Outline outline = outline_of_path(path);
    for (const Vec2& point : outline.rings.at(0)) EXPECT_NEAR(point.norm(), 1, 1e-3) << path;
  }
  // Radii that do not reach are enlarged: a half circle around the middle of the ends.
  const Outline enlarged = outline_of_path("M0,0 A0.1,0.1 0 0 1 4,0 Z");
  for (const Vec2& point : enlarged.rings.at(0)) EXPECT_NEAR((point - Vec2(2, 0)).norm(), 2, 2e-3);
}

TEST(OutlinePath, what_is_written_in_another_way_is_the_same) {
  const auto same = [](const char* one, const char* other) {
    const Outline a = outline_of_path(one), b = outline_of_path(other);
    ASSERT_EQ(a.rings.size(), b.rings.size());
    for (std::size_t r = 0; r < a.rings.size(); ++r) {
      ASSERT_EQ(a.rings[r].size(), b.rings[r].size()) << one;
      for (std::size_t n = 0; n < a.rings[r].size(); ++n)
        EXPECT_LT((a.rings[r][n] - b.rings[r][n]).norm(), 1e-12) << one;
    }
  };
  same("M1 1L2.5.5-3 4Z", "M 1,1 L 2.5,0.5 L -3,4 Z");
  same("m1 1 1.5-.5-5.5+3.5z", "M 1,1 L 2.5,0.5 L -3,4 Z");
  same("M0 0C1 1 2 1 3 0S5-1 6 0L6 5Z", "M0 0C1 1 2 1 3 0C4-1 5-1 6 0L6 5Z");
  same("M0 0Q1 2 2 0T4 0L4 5Z", "M0 0Q1 2 2 0Q3-2 4 0L4 5Z");
  same("M0 0A1 1 0 012 0Z", "M0 0A1 1 0 0 1 2 0Z");         // flags without blanks
  same("M0 0h1v1 m3 0h1v1", "M0 0L1 0L1 1Z M4 1L5 1L5 2Z"); // from the last point, where no Z leads back
  same("M0 0h1v1z m3 0h1v1z", "M0 0L1 0L1 1Z M3 0L4 0L4 1Z");
}

TEST(OutlinePath, faults_tell_where) {
  const auto fault_at = [](const char* path) {
    try {
      static_cast<void>(outline_of_path(path));
    } catch (const PathFault& fault) {
      return static_cast<int>(fault.at);
    }
    return -1;
  };
  EXPECT_EQ(fault_at(""), 0);
  EXPECT_EQ(fault_at("L 1 1"), 1);
  EXPECT_EQ(fault_at("M 0 0 K 1"), 6);
  EXPECT_EQ(fault_at("M 0 0 L 1 x"), 10);
  EXPECT_EQ(fault_at("M 0 0 L 1"), 9);
  EXPECT_EQ(fault_at("M 0 0 L 1 0 L 0 1 Z 5"), 20);
  EXPECT_EQ(fault_at("M 0 0 A 1 1 0 2 0 1 1"), 14);
  EXPECT_EQ(fault_at("M 0 0 L 1e300 0 L 1 1"), 8);
  EXPECT_EQ(fault_at("M 0 0 L 1 0 Z"), 0); // no area
  EXPECT_EQ(fault_at("M 0 0 L 1 0 L 0 1 Z"), -1);
}

TEST(Outline, a_ring_within_a_ring_is_a_hole) {
  const Outline ring = named_outline(OutlineName::Ring);
  EXPECT_TRUE(ring.contains({0.8, 0}));
  EXPECT_FALSE(ring.contains({0.3, 0}));
  EXPECT_FALSE(ring.contains({1.1, 0}));
  EXPECT_NEAR(ring.area(), pi * (1 - 0.36), 5e-3);
}

TEST(Outline, is_fitted_into_a_size_about_the_origin) {
  const Outline heart = fitted(named_outline(OutlineName::Heart), 0.25);
  EXPECT_NEAR(heart.box().sizes().maxCoeff(), 0.25, 1e-12);
  EXPECT_LT(heart.box().center().norm(), 1e-12);
}

// Shapes with the number of their holes, in cells of several sizes.
struct Case {
  OutlineName name;
  int holes;
  double cell;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (double cell : {0.08, 0.05, 0.031, 0.02}) {
    for (OutlineName name : {OutlineName::Heart, OutlineName::Star, OutlineName::Disc, OutlineName::Drop})
      all.push_back({name, 0, cell});
    for (OutlineName name : {OutlineName::Ring, OutlineName::Gear}) all.push_back({name, 1, cell});
  }
  return all;
}

std::string name_of(const Case& c) {
  return "outline " + std::to_string(static_cast<int>(c.name)) + ", cells of " + std::to_string(c.cell);
}

double distance_to(const Outline& outline, const Vec2& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Contour& ring : outline.rings)
    for (std::size_t n = 0; n < ring.size(); ++n) {
      const Vec2 &a = ring[n], way = ring[(n + 1) % ring.size()] - a;
      const double share = std::clamp((point - a).dot(way) / way.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (point - a - share * way).norm());
    }
  return least;
}

// The sides of one triangle alone.
std::vector<std::pair<std::uint32_t, std::uint32_t>> border_of(const PolygonMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (std::size_t t = 0; t < mesh.polygons(); ++t)
    for (std::size_t n = 0; n < 3; ++n)
      ++sides[std::minmax(mesh.corners[3 * t + n], mesh.corners[3 * t + (n + 1) % 3])];
  std::vector<std::pair<std::uint32_t, std::uint32_t>> border;
  for (const auto& [side, count] : sides)
    if (count == 1) border.push_back(side);
  return border;
}

double least_angle(const PolygonMesh& mesh) {
  double least = 180;
  for (std::size_t t = 0; t < mesh.polygons(); ++t)
    for (std::size_t n = 0; n < 3; ++n) {
      const Vec3 a = mesh.points[mesh.corners[3 * t + n]];
      const Vec3 u = mesh.points[mesh.corners[3 * t + (n + 1) % 3]] - a,
                 v = mesh.points[mesh.corners[3 * t + (n + 2) % 3]] - a;
      least = std::min(least, arc_tangent(u.cross(v).z(), u.dot(v)) * 180 / pi);
    }
  return least;
}

TEST(OutlineMesh, covers_its_outline_with_sound_triangles) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(name_of(c));
    const Outline outline = fitted(named_outline(c.name), 1);
    const PolygonMesh mesh = triangles_within(outline, c.cell);
    EXPECT_NEAR(area_of(mesh), outline.area(), 0.03 * outline.area());
    EXPECT_GT(least_angle(mesh), 12);
    for (const auto& [a, b] : border_of(mesh)) {
      const Vec2 p = mesh.points[a].head<2>(), q = mesh.points[b].head<2>();
      EXPECT_LT(distance_to(outline, p), 1e-3 * c.cell);
      EXPECT_LT(distance_to(outline, (p + q) / 2), 0.5 * c.cell); // where a sharp tip has become blunt
    }
    const CellCounts counts = count_cells(sheet_from(mesh)->map());
    EXPECT_EQ(static_cast<int>(counts.vertices) - static_cast<int>(counts.edges) +
                  static_cast<int>(counts.faces),
              1 - c.holes);
    EXPECT_EQ(counts.fragments, 1u);
  }
}

TEST(OutlineMesh, corners_are_vertices) {
  const Outline star = fitted(named_outline(OutlineName::Star), 1);
  ASSERT_EQ(star.rings.at(0).size(), 10u);
  const PolygonMesh mesh = triangles_within(star, 0.02);
  for (const Vec2& corner : star.rings[0])
    EXPECT_TRUE(std::ranges::any_of(mesh.points, [&](const Vec3& p) { return p.head<2>() == corner; }));
}

TEST(OutlineMesh, a_solid_has_the_volume_of_its_triangles_times_its_depth) {
  for (const Case& c : cases()) {
    if (c.cell < 0.03) continue;
    SCOPED_TRACE(name_of(c));
    const PolygonMesh mesh = triangles_within(fitted(named_outline(c.name), 1), c.cell);
    const CellMesh solid = extruded(mesh, 0.2, 3);
    double volume = 0;
    for (std::size_t cell = 0; cell < solid.cells(); ++cell) {
      EXPECT_GT(signed_volume(solid, cell), 0);
      volume += signed_volume(solid, cell);
    }
    EXPECT_NEAR(volume, 0.2 * area_of(mesh), 1e-12);
    const SewnSolid sewn = sew_cells(solid);
    EXPECT_EQ(sewn.turned, 0u);
    const CellCounts counts = count_cells(sewn.map->map());
    EXPECT_EQ(counts.fragments, 1u);
    EXPECT_EQ(static_cast<int>(counts.vertices) - static_cast<int>(counts.edges) +
                  static_cast<int>(counts.faces) - static_cast<int>(counts.volumes),
              1 - c.holes);
  }
}

TEST(OutlineMesh, is_empty_where_the_outline_is_far_thinner_than_a_cell) {
  EXPECT_EQ(triangles_within(outline_of_path("M 0 0 L 1 0 L 1 0.001 L 0 0.001 Z"), 0.2).polygons(), 0u);
}

} // namespace
} // namespace rend::outline_test
