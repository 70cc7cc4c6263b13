#include "render/draw/packing.h"

#include "sim/base/check.h"
#include "tests/render/pictures.h"

#include <gtest/gtest.h>
#include <limits>

namespace rend::packing_test {
namespace {

using namespace test;
using Eigen::Vector3f;

Vector3f position(const Corner& corner) {
  return Vector3f(corner.position.data());
}
Vector3f normal(const Corner& corner) {
  return Vector3f(corner.normal.data());
}

std::vector<Corner> packed_corners(const FrameBody& body) {
  std::vector<Corner> packed;
  std::vector<TexturePoint> points;
  pack(body, packed, points);
  EXPECT_TRUE(points.empty());
  return packed;
}

TEST(Packing, GivesAFlatTriangleItsNormal) {
  FrameBody body;
  add_triangle(body, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, red);
  const std::vector<Corner> packed = packed_corners(body);
  for (const Corner& corner : packed) EXPECT_EQ(normal(corner), Vector3f(0, 0, 1));
}

TEST(Packing, TurnsATriangleAroundItsNormalWithItsLines) {
  FrameBody body;
  add_triangle(body, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, red, {Line::None, Line::Cell, Line::Torn});
  for (Corner& corner : body.corners) corner.normal = {0, 0, -1};
  const std::vector<Corner> packed = packed_corners(body);
  EXPECT_EQ(position(packed[1]), Vector3f(0, 2, 0));
  EXPECT_EQ(position(packed[2]), Vector3f(2, 0, 0));
  const std::array<std::uint8_t, 4> lines{0, 3, 1, 0}; // the torn line is still opposite (0, 2, 0)
  for (const Corner& corner : packed) {
    EXPECT_EQ(corner.line, lines);
    EXPECT_EQ(normal(corner), Vector3f(0, 0, -1));
  }
}

TEST(Packing, TurnsNoTriangleOfASolid) {
  FrameBody body;
  body.two_sided = false;
  add_triangle(body, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, red);
  for (Corner& corner : body.corners) corner.normal = {0, 0, -1};
  const std::vector<Corner> packed = packed_corners(body);
  EXPECT_EQ(position(packed[1]), Vector3f(2, 0, 0));
}

TEST(Packing, LeavesATriangleWithoutAreaAlone) {
  FrameBody body;
  add_triangle(body, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, red);
  const std::vector<Corner> packed = packed_corners(body);
  EXPECT_EQ(normal(packed[0]), Vector3f(0, 0, 0));
}

TEST(Packing, RefusesNumbersThatAreNotFinite) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    for (const bool in_normal : {false, true}) {
      FrameBody body = screen(0, 1, red);
      (in_normal ? body.corners[4].normal : body.corners[4].position)[1] = bad;
      EXPECT_THROW(packed_corners(body), InternalError);
    }
}

TEST(Packing, LeavesOutWhatIsTooFarToBeDrawn) {
  FrameBody body = screen(0, 1, red);
  const std::size_t near = body.corners.size();
  for (const double far : {1e33, -1e36, 1e150, -1e308}) {
    add_triangle(body, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, red);
    body.corners.back().position = as_floats({0, far, 0});
  }
  const std::vector<Corner> packed = packed_corners(body);
  EXPECT_EQ(packed.size(), near);
  EXPECT_EQ(bounds_of(packed).max().y(), bounds_of(std::span(body.corners).first(near)).max().y());
}

TEST(Packing, KeepsThePlacesInAPictureWithTheirCorners) {
  FrameBody body;
  body.texture.front = make_texture(Image(1, 1));
  add_triangle(body, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, red); // is turned
  for (Corner& corner : body.corners) corner.normal = {0, 0, -1};
  add_triangle(body, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, red); // is left out
  body.corners.back().position = as_floats({0, 1e33, 0});
  add_triangle(body, {0, 0, 5}, {2, 0, 5}, {0, 2, 5}, red);
  for (const Corner& corner : body.corners) // any number that follows from the place
    body.texture_points.push_back({corner.position[0] + corner.position[2], corner.position[1]});
  std::vector<Corner> packed;
  std::vector<TexturePoint> points;
  pack(body, packed, points);
  ASSERT_EQ(packed.size(), 6U);
  ASSERT_EQ(points.size(), packed.size());
  EXPECT_EQ(position(packed[1]), Vector3f(0, 2, 0)) << "turned";
  for (std::size_t n = 0; n < packed.size(); ++n)
    EXPECT_EQ(points[n], (TexturePoint{packed[n].position[0] + packed[n].position[2], packed[n].position[1]}));
  body.texture_points.pop_back();
  EXPECT_THROW(pack(body, packed, points), InternalError);
}

TEST(Packing, BoundsHoldAllCorners) {
  EXPECT_TRUE(bounds_of({}).isEmpty());
  FrameBody body = screen(-2, 1, red);
  add_triangle(body, {0, 0, 0}, {3, 0, 0}, {0, 5, 4}, grey);
  EXPECT_EQ(bounds_of(body.corners).min(), Eigen::Vector3d(-1, -2, -1));
  EXPECT_EQ(bounds_of(body.corners).max(), Eigen::Vector3d(3, 5, 4));
}

} // namespace
} // namespace rend::packing_test
