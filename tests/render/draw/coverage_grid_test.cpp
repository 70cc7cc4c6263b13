#include "render/draw/coverage_grid.h"

#include "tests/render/pictures.h"

#include <gtest/gtest.h>
#include <random>

namespace rend::coverage_grid_test {
namespace {

using namespace test;

TEST(CoverageGrid, MarksWhatARectangleTouchesAndNothingElse) {
  CoverageGrid grid(8, 6);
  grid.mark(1.5f, 2.0f, 3.0f, 2.5f);
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 8; ++column)
      EXPECT_EQ(grid.at(column, row), row == 2 && column >= 1 && column <= 3) << column << " " << row;
  EXPECT_TRUE(grid.any(-5, -5, 1.2f, 2.2f));
  EXPECT_FALSE(grid.any(4.1f, 0, 8, 6));
  const PixelRect box = grid.bounds();
  EXPECT_EQ((std::array{box.x, box.y, box.width, box.height}), (std::array{1, 2, 3, 1}));
}

TEST(CoverageGrid, WhatLiesBeyondTheGridMarksNothing) {
  CoverageGrid grid(4, 4);
  grid.mark(-3, -3, -0.5f, 9);
  grid.mark(4.5f, 0, 1e30f, 4);
  grid.mark(0, 4.01f, 4, 5);
  EXPECT_EQ(grid.bounds().width, 0);
  grid.mark(-1e30f, -1e30f, 1e30f, 1e30f);
  EXPECT_EQ(grid.bounds().width * grid.bounds().height, 16);
}

// Samples points of each triangle, and tests that their blocks are marked.
TEST(CoverageGrid, BlocksThatAreCoveredHoldEveryPointOfATriangle) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-1, 1), share(0, 1);
  constexpr int width = 300, height = 200;
  FrameCamera camera;
  const View view = view_of(camera, {}, 1.5);
  for (int n = 0; n < 200; ++n) {
    FrameBody body;
    const auto point = [&] { return Eigen::Vector3f(place(random), place(random), place(random)); };
    const Eigen::Vector3f a = point(), b = point(), c = point();
    add_triangle(body, a, b, c, red);
    CoverageGrid blocks = blocks_of(width, height);
    mark_covered(blocks, body.corners, view, width, height);
    for (int k = 0; k < 50; ++k) {
      const float u = share(random), v = share(random) * (1 - u);
      const Eigen::Vector3d in = (a + u * (b - a) + v * (c - a)).cast<double>();
      const Eigen::Vector4d clip = view.world_to_clip() * in.homogeneous();
      const int x = static_cast<int>(std::floor((0.5 * clip.x() / clip.w() + 0.5) * width));
      const int y = static_cast<int>(std::floor((0.5 * clip.y() / clip.w() + 0.5) * height));
      if (x < 0 || y < 0 || x >= width || y >= height) continue;
      ASSERT_TRUE(blocks.at(x / block_side, y / block_side)) << n;
    }
  }
}

TEST(CoverageGrid, ATriangleAroundTheEyeCoversThePicture) {
  FrameBody body;
  add_triangle(body, {3, -3, 2}, {0, 0, 0}, {1, 0, 0}, red);
  CoverageGrid blocks = blocks_of(100, 40);
  EXPECT_EQ(blocks.columns() * blocks.rows(), 4 * 2);
  mark_covered(blocks, body.corners, view_of(FrameCamera{}, {}, 2.5), 100, 40);
  const PixelRect box = pixels_of(blocks.bounds(), 100, 40);
  EXPECT_EQ((std::array{box.x, box.y, box.width, box.height}), (std::array{0, 0, 100, 40}));
}

TEST(CoverageGrid, RunsHoldEverySquareOnceByItsKind) {
  const auto kind = [](int column, int row) { return (column / 3 + row) % 3; };
  const auto all = runs(10, 7, 3, kind);
  std::vector<int> seen(70, -1);
  for (std::size_t k = 0; k < all.size(); ++k)
    for (const PixelRect& box : all[k])
      for (int x = box.x; x < box.x + box.width; ++x) {
        EXPECT_EQ(box.height, 1);
        int& square = seen[static_cast<std::size_t>(10 * box.y + x)];
        EXPECT_EQ(square, -1);
        square = static_cast<int>(k);
      }
  for (int row = 0; row < 7; ++row)
    for (int column = 0; column < 10; ++column)
      EXPECT_EQ(seen[static_cast<std::size_t>(10 * row + column)], kind(column, row));
}

} // namespace
} // namespace rend::coverage_grid_test
