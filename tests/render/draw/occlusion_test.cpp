#include "render/draw/occlusion.h"

#include "render/draw/device.h"
#include "render/draw/renderer.h"
#include "tests/render/pictures.h"

#include <cmath>
#include <gtest/gtest.h>

namespace rend::occlusion_test {
namespace {

using namespace test;
using Eigen::Vector3d;

constexpr int width = 960, height = 720;
constexpr double reach_share = 0.11; // occlusion.cpp

class OcclusionTest : public testing::Test {
protected:
  static void SetUpTestSuite() { device_ = make_device(); }
  static void TearDownTestSuite() { device_.reset(); }

  static Image picture(Frame frame, bool occlusion, int samples = 4) {
    frame.occlusion = occlusion;
    Renderer renderer(width, height, samples);
    renderer.draw(frame);
    return renderer.read();
  }

  static int difference(const Frame& frame, int samples = 4) {
    return largest_difference(picture(frame, true, samples), picture(frame, false, samples));
  }

private:
  static inline std::unique_ptr<Device> device_;
};

struct Hit {
  double distance; // [m]
  Vector3d normal; // towards the ray's origin
};

// The first triangle hit by a ray, by testing all of them (Möller and Trumbore 1997).
std::optional<Hit> cast(const Frame& frame, const Vector3d& from, const Vector3d& along) {
  std::optional<Hit> first;
  for (const FrameBody& body : frame.bodies)
    for (std::size_t n = 0; n < body.corners.size(); n += 3) {
      const auto at = [&](std::size_t k) {
        return Eigen::Map<const Eigen::Vector3f>(body.corners[n + k].position.data()).cast<double>().eval();
      };
      const Vector3d a = at(0), ab = at(1) - a, ac = at(2) - a, p = along.cross(ac);
      const double det = ab.dot(p);
      if (std::abs(det) < 1e-12) continue;
      const double u = (from - a).dot(p) / det;
      const Vector3d q = (from - a).cross(ab);
      const double v = along.dot(q) / det, t = ac.dot(q) / det;
      if (u < 0 || v < 0 || u + v > 1 || t < 1e-6 || (first && t > first->distance)) continue;
      const Vector3d normal = ab.cross(ac).normalized();
      first = Hit{t, normal.dot(along) < 0 ? normal : Vector3d(-normal)};
    }
  return first;
}

// The cosine-weighted share of the hemisphere that is occluded within the radius, with a fall-off by distance.
double kept(const Frame& frame, const Vector3d& at, const Vector3d& normal, double reach) {
  const Vector3d other = std::abs(normal.z()) < 0.9 ? Vector3d::UnitZ() : Vector3d::UnitX();
  const Vector3d x = other.cross(normal).normalized(), y = normal.cross(x);
  constexpr int rings = 16, turns = 48;
  double sum = 0;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < turns; ++j) {
      const double sine = std::sqrt((i + 0.5) / rings), turn = 2 * M_PI * (j + 0.5) / turns;
      const Vector3d along =
          sine * (std::cos(turn) * x + std::sin(turn) * y) + std::sqrt(1 - sine * sine) * normal;
      if (const auto hit = cast(frame, at + 1e-4 * normal, along))
        sum += std::max(1 - hit->distance * hit->distance / (reach * reach), 0.0);
    }
  return sum / (rings * turns);
}

// Three squares that meet in a corner, seen along the diagonal.
Frame corner_of_a_room() {
  Frame frame;
  frame.camera.eye = {3, -3.2, 2.6};
  frame.camera.target = {0.3, -0.3, 0.3};
  FrameBody body;
  const Eigen::Vector3f o(0, 0, 0), x(1.2f, 0, 0), y(0, -1.2f, 0), z(0, 0, 1.2f);
  const std::array<std::array<Eigen::Vector3f, 2>, 3> walls{{{x, y}, {x, z}, {y, z}}};
  for (const auto& [a, b] : walls) {
    add_triangle(body, o, a, a + b, grey);
    add_triangle(body, o, a + b, b, grey);
  }
  frame.bodies.push_back(body);
  return frame;
}

// One pixel in 400, against 768 rays each.
TEST_F(OcclusionTest, ACornerIsAsDarkAsRaysSay) {
  const Frame frame = corner_of_a_room();
  const Image with = picture(frame, true), without = picture(frame, false);
  const View view = view_of(frame.camera, {}, static_cast<double>(width) / height);
  const Eigen::Matrix3d axes = view.world_to_eye.topLeftCorner<3, 3>().transpose();
  double worst = 0, sum = 0, darkest = 0;
  int count = 0;
  for (int row = 10; row < height; row += 20)
    for (int column = 10; column < width; column += 20) {
      const double x = (2 * (column + 0.5) / width - 1) / view.eye_to_clip(0, 0);
      const double y = (1 - 2 * (row + 0.5) / height) / view.eye_to_clip(1, 1);
      const Vector3d along = (axes * Vector3d(x, y, -1)).normalized();
      const auto hit = cast(frame, view.eye, along);
      if (!hit) continue;
      const double expected =
          kept(frame, view.eye + hit->distance * along, hit->normal, reach_share * view.distance);
      const double ratio =
          static_cast<double>(brightness(with, column, row)) / brightness(without, column, row);
      const double found = 1 - ratio * ratio; // pixel values are square roots of light
      worst = std::max(worst, std::abs(found - expected));
      sum += std::abs(found - expected);
      darkest = std::max(darkest, expected);
      ++count;
    }
  EXPECT_GT(count, 300);
  EXPECT_GT(darkest, 0.4);
  EXPECT_LT(sum / count, 0.03);
  EXPECT_LT(worst, 0.15); // in the very corner, which the mean over neighbours brightens
}

TEST_F(OcclusionTest, APlaneKeepsNothingFromItself) {
  for (const Vector3d& eye : {Vector3d(0, -3, 2), Vector3d(2, -3, 0.4), Vector3d(0.5, 0.5, 3)}) {
    Frame frame;
    frame.camera.eye = eye;
    frame.bodies.push_back(table(0, 1, grey));
    EXPECT_LE(difference(frame), 1);
  }
}

// An octahedron and a finely tessellated ball. At a sharp edge the normal may be that of the neighbouring face:
// 2 % of the light.
TEST_F(OcclusionTest, AConvexBodyKeepsNothingFromItself) {
  for (const int parts : {4, 48}) {
    Frame frame = front_view();
    frame.camera.eye = {1, -3.5, 1.2};
    FrameBody body;
    const auto point = [&](int i, int j) {
      const double turn = 2 * M_PI * i / parts, rise = M_PI * j / (parts / 2);
      return Vector3d(std::sin(rise) * std::cos(turn), std::sin(rise) * std::sin(turn), -std::cos(rise))
          .cast<float>()
          .eval();
    };
    for (int i = 0; i < parts; ++i)
      for (int j = 0; j < parts / 2; ++j) {
        add_triangle(body, point(i, j), point(i + 1, j), point(i + 1, j + 1), grey);
        add_triangle(body, point(i, j), point(i + 1, j + 1), point(i, j + 1), grey);
      }
    frame.bodies.push_back(body);
    EXPECT_LE(difference(frame), parts == 4 ? 5 : 2) << parts;
  }
}

// No halo: an object farther in front than the radius does not darken what is behind it, up to its silhouette.
TEST_F(OcclusionTest, WhatIsOutOfReachKeepsNothing) {
  Frame frame = front_view();
  frame.bodies = {screen(0.5f, 1.2f, grey), screen(-0.5f, 0.4f, red)};
  for (const int samples : {1, 4, 16}) EXPECT_LE(difference(frame, samples), 1) << samples;
}

TEST_F(OcclusionTest, ABodyIsDarkerWhereItStandsOnTheFloorAndTheFloorIsNotTouched) {
  Frame frame = front_view();
  frame.camera.eye = {0, -4, 1.5};
  frame.bodies.push_back(screen(0, 0.5, grey));
  const Image in_the_air = picture(frame, true);
  EXPECT_LE(largest_difference(in_the_air, picture(frame, false)), 1);
  frame.floor = FrameFloor{-0.5};
  const Image with = picture(frame, true), without = picture(frame, false);
  int most = 0, lowest = 0;
  for (int row = 0; row < height; ++row) {
    const int loss = brightness(without, width / 2, row) - brightness(with, width / 2, row);
    if (loss > 1) lowest = row;
    most = std::max(most, loss);
  }
  EXPECT_GT(most, 60);
  const Image bare = [&] {
    frame.bodies.clear();
    return picture(frame, true);
  }();
  for (int row = lowest + 2; row < height; ++row)
    EXPECT_EQ(brightness(with, width / 2, row), brightness(without, width / 2, row)) << row;
  EXPECT_EQ(bare, picture(frame, false));
}

TEST_F(OcclusionTest, OfATransparentPictureOnlyTheColoursAreDarker) {
  Frame frame = corner_of_a_room();
  frame.transparent = true;
  const Image with = picture(frame, true), without = picture(frame, false);
  EXPECT_GT(largest_difference(with, without), 40);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) ASSERT_EQ(with.at(x, y)[3], without.at(x, y)[3]);
}

} // namespace
} // namespace rend::occlusion_test
