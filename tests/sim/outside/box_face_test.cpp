// A box and a triangle overlap, or are apart on an axis: against clipping the triangle by the sides of the box.
#include "sim/outside/box_face.h"

#include <gtest/gtest.h>

#include <random>

namespace rend::box_face_test {
namespace {

// What is left of a polygon inside a box (Sutherland and Hodgman).
std::vector<Vec3> clipped(std::vector<Vec3> polygon, const Box& box) {
  for (int side = 0; side < 6 && !polygon.empty(); ++side) {
    const int axis = side / 2;
    const double sign = side % 2 == 0 ? 1 : -1, limit = side % 2 == 0 ? box.low[axis] : -box.high[axis];
    const auto inside = [&](const Vec3& x) { return sign * x[axis] - limit; };
    std::vector<Vec3> left;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      const double at_a = inside(a), at_b = inside(b);
      if (at_a >= 0) left.push_back(a);
      if ((at_a >= 0) != (at_b >= 0)) left.emplace_back(a + at_a / (at_a - at_b) * (b - a));
    }
    polygon = std::move(left);
  }
  return polygon;
}

TEST(BoxFace, is_apart_where_clipping_leaves_nothing) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> at(-2, 2), size(0.05, 1);
  int overlapping = 0, apart = 0;
  for (int n = 0; n < 20000; ++n) {
    Box box;
    TriangleCorners x;
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = -size(random);
      box.high[axis] = size(random);
      for (Vec3& corner : x) corner[axis] = at(random);
    }
    const BoxSeparation found = separation(box, x);
    if (std::abs(found.distance) < 1e-12) continue; // either may be
    const bool overlap = !clipped({x[0], x[1], x[2]}, box).empty();
    ASSERT_EQ(found.distance < 0, overlap) << n << " " << found.distance;
    ++(overlap ? overlapping : apart);
  }
  EXPECT_GT(overlapping, 2000);
  EXPECT_GT(apart, 2000);
}

TEST(BoxFace, the_plane_touches_the_box_and_leaves_the_corners_at_their_distance) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> at(-2, 2);
  for (int n = 0; n < 2000; ++n) {
    Box box;
    box.low = Vec3(-0.5, -0.3, -0.2);
    box.high = Vec3(0.4, 0.6, 0.1);
    TriangleCorners x;
    for (Vec3& corner : x)
      for (int axis = 0; axis < 3; ++axis) corner[axis] = at(random);
    const auto [plane, distance] = separation(box, x);
    ASSERT_NEAR(plane.normal.norm(), 1, 1e-12);
    double nearest = 10, of_box = -10;
    for (const Vec3& corner : x) nearest = std::min(nearest, plane.normal.dot(corner) - plane.offset);
    for (int k = 0; k < 8; ++k) {
      const Vec3 corner(k & 1 ? box.high.x() : box.low.x(), k & 2 ? box.high.y() : box.low.y(),
                        k & 4 ? box.high.z() : box.low.z());
      of_box = std::max(of_box, plane.normal.dot(corner) - plane.offset);
    }
    ASSERT_NEAR(of_box, 0, 1e-12) << n;
    ASSERT_NEAR(nearest, distance, 1e-12) << n;
  }
}

} // namespace
} // namespace rend::box_face_test
