// FLIP against values of the authors' program. (tests/compare/recompute.py compares with an independent
// implementation in numpy.)
#include "render/compare/flip.h"

#include "render/compare/metrics.h"
#include "tests/render/compare/plain_pictures.h"

#include <gtest/gtest.h>

namespace rend::flip_test {
namespace {

using namespace test;

constexpr double tolerance = 5e-5;

FlipFigures flip(const Picture& a, const Picture& b) {
  return measure(a, b, {}, {}).flip;
}

TEST(Flip, of_flat_pictures_is_that_of_the_reference) {
  EXPECT_EQ(flip(noise(40, 30, 1), noise(40, 30, 1)).mean, 0);
  EXPECT_NEAR(flip(flat(40, 30, 0, 255, 0), flat(40, 30, 0, 0, 255)).mean, 1, tolerance);
  EXPECT_NEAR(flip(flat(40, 30, 0), flat(40, 30, 255)).mean, 0.967380, tolerance);
  EXPECT_NEAR(flip(flat(40, 30, 128), flat(40, 30, 129)).mean, 0.029855, tolerance);
  EXPECT_NEAR(flip(flat(40, 30, 128), flat(40, 30, 136)).mean, 0.127561, tolerance);
}

TEST(Flip, of_one_white_pixel_is_that_of_the_reference) {
  const Picture black = flat(64, 64, 0);
  Picture dot = black;
  for (std::size_t c = 0; c < 3; ++c) dot.planes[c][32 * 64 + 32] = 255;
  const FlipFigures figures = flip(black, dot);
  EXPECT_NEAR(figures.mean, 0.003493, tolerance);
  EXPECT_NEAR(figures.max, 0.864907, tolerance);
  EXPECT_GT(figures.median, 10 * figures.mean); // zeros have no weight
}

TEST(Flip, does_not_ask_which_picture_comes_first) {
  EXPECT_EQ(flip_map(noise(50, 40, 1), noise(50, 40, 2), 1), flip_map(noise(50, 40, 2), noise(50, 40, 1), 1));
}

TEST(Flip, is_the_same_on_any_number_of_threads) {
  const Picture a = noise(61, 47, 1), b = noise(61, 47, 2);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(flip_map(a, b, 1), flip_map(a, b, threads));
}

TEST(Flip, takes_pictures_smaller_than_its_filters) {
  EXPECT_NEAR(flip(flat(1, 1, 0), flat(1, 1, 255)).mean, 0.967380, tolerance);
  EXPECT_NEAR(flip(flat(3, 2, 128), flat(3, 2, 136)).mean, 0.127561, tolerance);
}

} // namespace
} // namespace rend::flip_test
