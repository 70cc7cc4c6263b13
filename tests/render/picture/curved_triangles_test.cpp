// Curved triangles lie close to the surface whose normals they have, without gaps between them.
#include "render/picture/curved_triangles.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <map>

namespace rend::curved_triangles_test {
namespace {

using Vec3d = Eigen::Vector3d;

Vec3d place(const Corner& corner) {
  return Eigen::Vector3f(corner.position.data()).cast<double>();
}

Corner corner(const Vec3d& x, const Vec3d& normal) {
  Corner made{};
  made.position = as_floats(x);
  made.normal = as_floats(normal);
  made.colour = {10, 20, 30, 255};
  return made;
}

// Of radius 1 about the origin: eight triangles, anticlockwise from outside.
FrameBody octahedron() {
  FrameBody body;
  for (int n = 0; n < 8; ++n) {
    std::array<Vec3d, 3> ends;
    for (int k = 0; k < 3; ++k)
      ends[static_cast<std::size_t>(k)] = Vec3d::Unit(k) * ((n >> k & 1) ? -1.0 : 1.0);
    if (ends[0].cross(ends[1]).dot(ends[2]) < 0) std::swap(ends[1], ends[2]);
    for (const Vec3d& x : ends) body.corners.push_back(corner(x, x));
  }
  return body;
}

// How many triangles have each side, by its ends.
std::map<std::vector<float>, int> sides(const FrameBody& body) {
  std::map<std::vector<float>, int> all;
  for (std::size_t n = 0; n < body.corners.size(); ++n) {
    auto a = body.corners[n].position, b = body.corners[n % 3 == 2 ? n - 2 : n + 1].position;
    if (b < a) std::swap(a, b);
    ++all[{a[0], a[1], a[2], b[0], b[1], b[2]}];
  }
  return all;
}

// Its triangles divided into four, with all corners on the sphere.
FrameBody ball() {
  const FrameBody coarse = octahedron();
  FrameBody body;
  for (std::size_t n = 0; n < coarse.corners.size(); n += 3) {
    const std::array<Vec3d, 3> x{place(coarse.corners[n]), place(coarse.corners[n + 1]),
                                 place(coarse.corners[n + 2])};
    std::array<Vec3d, 3> middle; // opposite to each
    for (std::size_t k = 0; k < 3; ++k) middle[k] = (x[(k + 1) % 3] + x[(k + 2) % 3]).normalized();
    for (std::size_t k = 0; k < 3; ++k)
      for (const Vec3d& at : {x[k], middle[(k + 2) % 3], middle[(k + 1) % 3]})
        body.corners.push_back(corner(at, at));
    for (const Vec3d& at : middle) body.corners.push_back(corner(at, at));
  }
  return body;
}

double volume(const FrameBody& body) { // by the divergence theorem
  double six = 0;
  for (std::size_t n = 0; n < body.corners.size(); n += 3)
    six += place(body.corners[n]).dot(place(body.corners[n + 1]).cross(place(body.corners[n + 2])));
  return six / 6;
}

TEST(CurvedTriangles, of_a_coarse_ball_with_the_normals_of_a_sphere_are_nearly_one) {
  FrameBody body = ball();
  const double sphere = 4.18879; // 4/3 π
  EXPECT_LT(volume(body), 0.75 * sphere);
  curve_triangles(body, 6);
  ASSERT_EQ(body.corners.size(), std::size_t{3 * 32 * 36});
  EXPECT_NEAR(volume(body), sphere, 0.08 * sphere);
  for (const Corner& at : body.corners) {
    EXPECT_GT(place(at).norm(), 0.95);
    EXPECT_LT(place(at).norm(), 1 + 1e-6);
    EXPECT_GT(place(at).normalized().dot(Eigen::Vector3f(at.normal.data()).cast<double>()), 0.99);
  }
}

TEST(CurvedTriangles, have_no_gaps_between_them) {
  FrameBody body = octahedron();
  curve_triangles(body, 5);
  for (const auto& [side, triangles] : sides(body)) EXPECT_EQ(triangles, 2);
}

TEST(CurvedTriangles, keep_sharp_sides_straight_and_lines_where_they_were) {
  FrameBody body = octahedron();
  body.corners.resize(3);
  for (Corner& at : body.corners)
    at.line = {static_cast<std::uint8_t>(Line::Crease), static_cast<std::uint8_t>(Line::Cell), 0, 0};
  const Vec3d a = place(body.corners[1]), b = place(body.corners[2]); // the ends of the crease
  curve_triangles(body, 4);
  std::map<int, int> lines;
  for (std::size_t n = 0; n < body.corners.size(); ++n) {
    const int line = body.corners[n].line[n % 3];
    ++lines[line];
    if (line != static_cast<int>(Line::Crease)) continue;
    const std::size_t first = n - n % 3;
    for (const std::size_t end : {first + (n + 1) % 3, first + (n + 2) % 3})
      EXPECT_NEAR((place(body.corners[end]) - a).cross(b - a).norm(), 0, 1e-6);
  }
  EXPECT_EQ(lines[static_cast<int>(Line::Crease)], 4);
  EXPECT_EQ(lines[static_cast<int>(Line::Cell)], 4);
  EXPECT_EQ(lines[static_cast<int>(Line::None)], 3 * 16 - 8);
}

TEST(CurvedTriangles, of_a_flat_one_lie_in_it_and_so_do_their_places_in_a_picture) {
  FrameBody body;
  for (const Vec3d& x : {Vec3d(0, 0, 1), Vec3d(2, 0, 1), Vec3d(0, 3, 1)}) {
    body.corners.push_back(corner(x, {0, 0, 1}));
    body.texture_points.push_back({static_cast<float>(x.x() / 4), static_cast<float>(x.y() / 4)});
  }
  curve_triangles(body, 3);
  ASSERT_EQ(body.texture_points.size(), body.corners.size());
  double area = 0;
  for (std::size_t n = 0; n < body.corners.size(); ++n) {
    const Vec3d x = place(body.corners[n]);
    EXPECT_NEAR(x.z(), 1, 1e-6);
    EXPECT_NEAR(body.texture_points[n][0], x.x() / 4, 1e-6);
    EXPECT_NEAR(body.texture_points[n][1], x.y() / 4, 1e-6);
    if (n % 3 == 0) area += (place(body.corners[n + 1]) - x).cross(place(body.corners[n + 2]) - x).z() / 2;
  }
  EXPECT_NEAR(area, 3, 1e-6);
}

} // namespace
} // namespace rend::curved_triangles_test
