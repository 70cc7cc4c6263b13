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

TEST(Packing, GivesAFlatTriangleItsNormal) {
  FrameBody body;
  add_triangle(body, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, red);
  std::vector<Corner> packed;
  pack(body, packed);
  for (const Corner& corner : packed) EXPECT_EQ(normal(corner), Vector3f(0, 0, 1));
}

TEST(Packing, TurnsATriangleAroundItsNormalWithItsLines) {
  FrameBody body;
  add_triangle(body, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, red, {Line::None, Line::Cell, Line::Torn});
  for (Corner& corner : body.corners) corner.normal = {0, 0, -1};
  std::vector<Corner> packed;
  pack(body, packed);
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
  std::vector<Corner> packed;
  pack(body, packed);
  EXPECT_EQ(position(packed[1]), Vector3f(2, 0, 0));
}

TEST(Packing, LeavesATriangleWithoutAreaAlone) {
  FrameBody body;
  add_triangle(body, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, red);
  std::vector<Corner> packed;
  pack(body, packed);
  EXPECT_EQ(normal(packed[0]), Vector3f(0, 0, 0));
}

TEST(Packing, RefusesNumbersThatAreNotFinite) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    for (const bool in_normal : {false, true}) {
      FrameBody body = screen(0, 1, red);
      (in_normal ? body.corners[4].normal : body.corners[4].position)[1] = bad;
      std::vector<Corner> packed;
      EXPECT_THROW(pack(body, packed), InternalError);
    }
}

TEST(Packing, LeavesOutWhatIsTooFarToBeDrawn) {
  FrameBody body = screen(0, 1, red);
  const std::size_t near = body.corners.size();
  for (const double far : {1e33, -1e36, 1e150, -1e308}) {
    add_triangle(body, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, red);
    body.corners.back().position = as_floats({0, far, 0});
  }
  std::vector<Corner> packed;
  pack(body, packed);
  EXPECT_EQ(packed.size(), near);
  EXPECT_EQ(bounds_of(packed).max().y(), bounds_of(std::span(body.corners).first(near)).max().y());
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
