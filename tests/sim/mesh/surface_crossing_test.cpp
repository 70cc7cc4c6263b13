// Surfaces that cross themselves, made of cubes whose corners are moved.
#include "sim/mesh/surface_crossing.h"

#include "sim/mesh/mesh_files.h"

#include <gtest/gtest.h>

#include <random>

namespace rend::surface_crossing_test {
namespace {

ClosedSurface cube() {
  ClosedSurface surface;
  for (int n = 0; n < 8; ++n) surface.points.emplace_back(n & 1, n >> 1 & 1, n >> 2 & 1);
  surface.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return surface;
}

TEST(SurfaceCrossing, is_nowhere_in_a_surface_that_bounds_a_solid) {
  for (const double most : {9.0, 0.7, 0.1}) {
    ClosedSurface surface = cube();
    divide_edges(surface, most);
    EXPECT_FALSE(crossing_of(surface)) << most;
    for (Vec3& x : surface.points) x = Vec3(1e6 + 3 * x.x() + x.y(), 0.01 * x.y(), x.z() - 5 * x.x());
    EXPECT_FALSE(crossing_of(surface)) << "sheared, flat and far away: " << most;
  }
}

TEST(SurfaceCrossing, is_found_where_a_corner_is_pushed_through_a_side) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(0.2, 0.8);
  for (int n = 0; n < 50; ++n) {
    ClosedSurface surface = cube();
    surface.points.emplace_back(part(random), part(random),
                                1 - 1e-3); // a pit in the upper side, nearly there ...
    surface.triangles[2] = {4, 5, 8};
    surface.triangles[3] = {5, 7, 8};
    surface.triangles.push_back({7, 6, 8});
    surface.triangles.push_back({6, 4, 8});
    divide_edges(surface, n % 2 ? 9 : 0.3);
    ASSERT_FALSE(crossing_of(surface)) << n;
    surface.points[8].z() = -0.2; // ... through the lower side
    const auto at = crossing_of(surface);
    ASSERT_TRUE(at) << n;
    EXPECT_GE(at->z(), -0.2 - 1e-12);
    EXPECT_LE((*at - Vec3(0.5, 0.5, 0.5)).cwiseAbs().maxCoeff(), 0.7 + 1e-12);
  }
}

TEST(SurfaceCrossing, is_also_where_sides_only_touch) {
  ClosedSurface pit = cube();
  pit.points.emplace_back(0.4, 0.3, 0); // exactly to the lower side
  pit.triangles[2] = {4, 5, 8};
  pit.triangles[3] = {5, 7, 8};
  pit.triangles.push_back({7, 6, 8});
  pit.triangles.push_back({6, 4, 8});
  const auto at = crossing_of(pit);
  ASSERT_TRUE(at);
  EXPECT_NEAR((*at - pit.points[8]).norm(), 0, 1e-9);
  ClosedSurface flat = cube();
  for (Vec3& x : flat.points) x.z() = 0; // the upper side lies on the lower one
  EXPECT_TRUE(crossing_of(flat));
}

} // namespace
} // namespace rend::surface_crossing_test
