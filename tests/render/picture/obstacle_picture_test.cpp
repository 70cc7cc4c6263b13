// Drawn obstacles against solid geometry.
#include "render/picture/obstacle_picture.h"

#include "sim/base/math.h"

#include <gtest/gtest.h>

namespace rend::obstacle_picture_test {
namespace {

Vec3 vec(const std::array<float, 3>& v) {
  return {v[0], v[1], v[2]};
}

// By the divergence theorem: right only for a closed surface that is counter-clockwise everywhere.
double volume(const FrameBody& body) {
  double sum = 0;
  for (std::size_t n = 0; n < body.corners.size(); n += 3)
    sum += vec(body.corners[n].position)
               .dot(vec(body.corners[n + 1].position).cross(vec(body.corners[n + 2].position))) /
           6;
  return sum;
}

TEST(ObstaclePicture, a_sphere_has_its_volume_and_normals) {
  const Vec3 centre(0.3, -0.2, 0.1);
  const FrameBody ball = rounded_box(centre, Vec3::Zero(), 0.5, 16, {1, 2, 3});
  EXPECT_NEAR(volume(ball), 4 * pi / 3 * 0.125, 0.002);
  for (const Corner& corner : ball.corners) {
    EXPECT_NEAR((vec(corner.position) - centre - 0.5 * vec(corner.normal)).norm(), 0, 1e-6);
    EXPECT_EQ(corner.colour, (std::array<std::uint8_t, 4>{1, 2, 3, 255}));
  }
  EXPECT_FALSE(ball.two_sided);
}

TEST(ObstaclePicture, a_box_has_the_volume_of_a_box_with_round_edges) {
  const Vec3 core(0.4, 0.3, 0.2); // half sizes
  const double r = 0.1;
  const FrameBody box = rounded_box(Vec3(1, 2, 3), core, r, 8, {});
  const double inner = 8 * core.prod();
  const double sides = 8 * r * (core.x() * core.y() + core.y() * core.z() + core.z() * core.x());
  const double edges = 2 * pi * r * r * core.sum(), corners = 4 * pi / 3 * r * r * r;
  EXPECT_NEAR(volume(box), inner + sides + edges + corners, 2e-4);
  for (const Corner& corner : box.corners)
    EXPECT_LE(((vec(corner.position) - Vec3(1, 2, 3)).cwiseAbs() - core).maxCoeff(), r + 1e-6);
}

// Every corner of the picture, taken back, is where it is in the picture of the box that stands still.
TEST(ObstaclePicture, a_box_that_moves_is_where_it_is_at_the_time) {
  Box box{{0, 0, 0}, {0.4, 0.3, 0.2}};
  const FrameBody still = picture_of(box, BoxLook{}, 3);
  box.motion.rotate = std::array<double, 4>{1, 2, 2, 40};
  box.motion.keys = {{.at = 1, .position = Vec3(1, 2, 3)}};
  const FrameBody moved = picture_of(box, BoxLook{}, 3);
  const Pose pose = box.pose(3);
  ASSERT_EQ(moved.corners.size(), still.corners.size());
  EXPECT_NEAR(volume(moved), volume(still), 1e-6);
  for (std::size_t n = 0; n < still.corners.size(); ++n) {
    EXPECT_LT((pose.back(vec(moved.corners[n].position)) - vec(still.corners[n].position)).norm(), 1e-6);
    EXPECT_LT((pose.turn.transpose() * vec(moved.corners[n].normal) - vec(still.corners[n].normal)).norm(),
              1e-6);
  }
  EXPECT_LT((pose.of(box.middle()) - Vec3(1, 2, 3)).norm(), 1e-14);
}

// Two squares that meet along the y axis: flat, or at an angle.
std::vector<Corner> corners_of_wings(double height) {
  MeshObstacleSettings settings;
  const MeshObstacle wings(
      settings,
      {.points = {{-1, 0, height}, {0, 0, 0}, {1, 0, height}, {-1, 1, height}, {0, 1, 0}, {1, 1, height}},
       .triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}}});
  const FrameBody picture = picture_of(wings, MeshLook{});
  EXPECT_TRUE(picture.two_sided);
  return picture.corners;
}

TEST(ObstaclePicture, a_mesh_is_smooth_but_for_its_sharp_edges) {
  for (const Corner& corner : corners_of_wings(0.1)) // they meet at 11 degrees
    EXPECT_NEAR(corner.normal[2], 1, corner.position[0] == 0 ? 1e-3 : 0.01);
  for (const Corner& corner : corners_of_wings(1)) EXPECT_NEAR(corner.normal[2], std::sqrt(0.5), 1e-6); // 90
}

TEST(ObstaclePicture, a_mesh_that_moves_takes_its_normals_along) {
  MeshObstacleSettings settings;
  settings.motion.rotate = std::array<double, 4>{1, 0, 0, 90};
  settings.motion.centre = Vec3::Zero();
  const MeshObstacle mesh(settings, {.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}});
  const FrameBody now = moved(picture_of(mesh, MeshLook{}), mesh.pose(1));
  EXPECT_LT((vec(now.corners[2].position) - Vec3(0, 0, 1)).norm(), 1e-6);
  EXPECT_LT((vec(now.corners[2].normal) - Vec3(0, -1, 0)).norm(), 1e-6);
}

} // namespace
} // namespace rend::obstacle_picture_test
