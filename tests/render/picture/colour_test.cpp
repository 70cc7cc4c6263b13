#include "render/picture/colour.h"

#include <cmath>
#include <gtest/gtest.h>

namespace rend::colour_test {
namespace {

int distance(const Colour& a, const Colour& b) {
  int sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += std::abs(a[c] - b[c]);
  return sum;
}

TEST(Colour, OfFragmentsDiffer) {
  for (std::size_t a = 0; a < 24; ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_GT(distance(colour_of_number(a), colour_of_number(b)), 12) << a << " " << b;
  for (std::size_t a = 1; a < 100; ++a) // consecutive colours differ clearly
    EXPECT_GT(distance(colour_of_number(a), colour_of_number(a - 1)), 80) << a;
}

TEST(Colour, OfAQuantityGrowsLighter) {
  const auto light = [](double share) {
    const Colour c = colour_of_share(share);
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
  };
  for (int n = 1; n <= 100; ++n) EXPECT_GE(light(n / 100.0), light((n - 1) / 100.0)) << n;
  EXPECT_EQ(colour_of_share(-1), colour_of_share(0));
  EXPECT_EQ(colour_of_share(2), colour_of_share(1));
  EXPECT_EQ(colour_of_share(1), (Colour{253, 231, 37}));
}

TEST(Colour, ScaleIsOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_EQ(rounded_up(0), 0);
  EXPECT_EQ(rounded_up(1), 1);
  EXPECT_EQ(rounded_up(1.01), 2);
  EXPECT_EQ(rounded_up(3), 5);
  EXPECT_EQ(rounded_up(5.5), 10);
  EXPECT_NEAR(rounded_up(0.0034), 0.005, 1e-15);
  EXPECT_NEAR(rounded_up(720), 1000, 1e-9);
  for (double value = 1e-12; value < 1e12; value *= 1.37) EXPECT_GE(rounded_up(value), value);
}

} // namespace
} // namespace rend::colour_test
