// Spheres and boxes as polygons: closed, of the right size and place, and as fast as they are said to be.
#include "sim/export/obstacle_skin.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

namespace rend::obstacle_skin_test {
namespace {

// By cones over the triangles of its quads [m³].
double volume_of(const ObstacleSkin& skin) {
  double sixfold = 0;
  for (const auto& q : skin.quads)
    for (const auto& [a, b, c] : {std::array{q[0], q[1], q[2]}, std::array{q[0], q[2], q[3]}}) {
      const auto at = [&](std::int32_t p) { return skin.points[static_cast<std::size_t>(p)]; };
      sixfold += at(a).dot(at(b).cross(at(c)));
    }
  return sixfold / 6;
}

void expect_closed(const ObstacleSkin& skin) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> sides;
  for (const auto& quad : skin.quads)
    for (std::size_t n = 0; n < 4; ++n) ++sides[{quad[n], quad[(n + 1) % 4]}];
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(sides.contains({side.second, side.first}));
  }
  EXPECT_EQ(skin.points.size() - sides.size() / 2 + skin.quads.size(), 2u) << "no sphere by Euler's formula";
}

Sphere sphere_of(SphereSettings settings) {
  settings.radius = 0.25;
  settings.centre = {1, 2, 3};
  return Sphere(settings);
}

TEST(ObstacleSkin, of_a_sphere_is_closed_and_has_its_radius_and_nearly_its_volume) {
  World world;
  world.spheres.push_back(sphere_of({}));
  const ObstacleSkin skin = obstacle_skins(world, 0).at(0);
  EXPECT_EQ(skin.name, "sphere 1");
  expect_closed(skin);
  for (const Vec3& x : skin.points) EXPECT_NEAR((x - Vec3(1, 2, 3)).norm(), 0.25, 1e-15);
  for (const auto& quad : skin.quads) {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t p : quad) middle += 0.25 * skin.points[static_cast<std::size_t>(p)];
    EXPECT_NEAR((middle - Vec3(1, 2, 3)).norm(), 0.25, 0.004 * 0.25 * 2.2); // a face's middle lies deepest
  }
  EXPECT_NEAR(volume_of(skin), 4 * std::numbers::pi / 3 * std::pow(0.25, 3), 0.01 * 4.19 * std::pow(0.25, 3));
}

TEST(ObstacleSkin, of_a_box_goes_along_with_its_keys) {
  World world;
  Box box{.low = Vec3(0, 0, 0), .high = Vec3(1, 2, 3)};
  box.motion.keys = {{.at = 2, .position = Vec3(10, 0, 0), .rotate = Vec3(0, 0, 90)}};
  world.boxes.push_back(box);
  const ObstacleSkin before = obstacle_skins(world, 0).at(0), after = obstacle_skins(world, 2).at(0);
  for (const ObstacleSkin& skin : {before, after}) {
    EXPECT_EQ(skin.name, "box 1");
    expect_closed(skin);
    EXPECT_NEAR(volume_of(skin), 6, 1e-12);
  }
  Vec3 low = Vec3::Constant(1e9), high = -low; // turned by a right angle, about its middle at (10, 0, 0)
  for (const Vec3& x : after.points) low = low.cwiseMin(x), high = high.cwiseMax(x);
  EXPECT_TRUE(low.isApprox(Vec3(9, -0.5, -1.5), 1e-14)) << low.transpose();
  EXPECT_TRUE(high.isApprox(Vec3(11, 0.5, 1.5), 1e-14)) << high.transpose();
}

TEST(ObstacleSkin, has_the_velocities_of_its_points) {
  World world;
  world.spheres.push_back(sphere_of({.velocity = Vec3(1, 0, 0), .rotate = std::array<double, 4>{0, 0, 1, 90}}));
  Box box{.low = Vec3(0, 0, 0), .high = Vec3(1, 2, 3)};
  box.motion.keys = {{.at = 1, .position = Vec3(1, 0, 0)}, {.at = 2, .rotate = Vec3(40, 0, 90)}};
  world.boxes.push_back(box);
  world.spheres[0].centre = world.spheres[0].start + 0.7 * world.spheres[0].velocity; // its state at 0.7 s
  const std::vector<ObstacleSkin> now = obstacle_skins(world, 0.7);
  for (std::size_t p = 0; p < now[0].points.size(); ++p) {
    const Vec3 arm = now[0].points[p] - world.spheres[0].centre;
    const Vec3 exact = Vec3(1, 0, 0) + Vec3(0, 0, std::numbers::pi / 2).cross(arm);
    EXPECT_LT((now[0].velocities[p] - exact).norm(), 1e-5);
  }
  constexpr double h = 1e-4;
  const ObstacleSkin before = obstacle_skins(world, 0.7 - h).at(1),
                     after = obstacle_skins(world, 0.7 + h).at(1);
  for (std::size_t p = 0; p < now[1].points.size(); ++p)
    EXPECT_LT((now[1].velocities[p] - (after.points[p] - before.points[p]) / (2 * h)).norm(), 1e-4);
}

TEST(ObstacleSkin, of_a_mesh_is_its_triangles_where_they_have_moved_to) {
  MeshObstacleSettings settings;
  settings.motion.velocity = Vec3(0, 0, 2);
  World world;
  world.meshes.emplace_back(
      settings, ObstacleSurface{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}});
  const ObstacleSkin skin = obstacle_skins(world, 0.5).at(0);
  EXPECT_EQ(skin.name, "obstacle 1");
  EXPECT_TRUE(skin.quads.empty());
  ASSERT_EQ(skin.triangles.size(), 1u);
  EXPECT_TRUE(skin.points[1].isApprox(Vec3(1, 0, 1), 1e-14));
  EXPECT_LT((skin.velocities[1] - Vec3(0, 0, 2)).norm(), 1e-8);
}

} // namespace
} // namespace rend::obstacle_skin_test
