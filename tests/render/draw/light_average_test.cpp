#include "render/draw/light_average.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rend::light_average_test {
namespace {

using Picture = std::vector<std::uint8_t>;

// sRGB by the standard, with the C library's power.
double light(double level) {
  const double number = level / 255;
  return number <= 0.04045 ? number / 12.92 : std::pow((number + 0.055) / 1.055, 2.4);
}
double level(double light) {
  return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

Picture mean(const std::vector<std::pair<Picture, int>>& pictures, bool opaque) {
  LightAverage average;
  average.start(pictures.front().first.size(), opaque);
  for (const auto& [picture, weight] : pictures) average.add(picture, weight);
  Picture out(pictures.front().first.size());
  average.mean(out);
  return out;
}

TEST(LightAverage, LevelsAndLightsAreThoseOfTheStandard) {
  for (int n = 0; n < 256; ++n) {
    const auto number = static_cast<std::uint8_t>(n);
    EXPECT_NEAR(light_of_level(number), 65535 * light(n), 0.51) << n;
    EXPECT_EQ(level_of_light(light_of_level(number)), n);
  }
  for (int n = 0; n < 65536; ++n)
    ASSERT_NEAR(level_of_light(static_cast<std::uint16_t>(n)), level(n / 65535.0), 0.51) << n;
}

TEST(LightAverage, HalfOfWhiteIsLevel188) {
  const Picture out = mean({{Picture(400, 255), 3}, {Picture(400, 0), 3}}, true);
  EXPECT_EQ(out[0], 188);
  EXPECT_EQ(out[397], 188);
}

TEST(LightAverage, OfAnyTwoLevelsIsTheMeanOfTheirLights) {
  for (int a = 0; a < 256; a += 5)
    for (int b = 0; b < 256; b += 3) {
      const Picture out = mean(
          {{Picture(4, static_cast<std::uint8_t>(a)), 1}, {Picture(4, static_cast<std::uint8_t>(b)), 7}}, true);
      ASSERT_NEAR(out[1], level((light(a) + 7 * light(b)) / 8), 0.56) << a << " " << b;
    }
}

// Pictures of all levels with all alphas that there can be, where one pixel of each piece differs.
TEST(LightAverage, WhatIsTheSameInAllPicturesStaysAsItIs) {
  for (const bool opaque : {true, false}) {
    Picture all;
    for (int alpha = 0; alpha < 256; ++alpha)
      for (int n = 0; n <= (opaque ? 255 : alpha); ++n)
        for (const int value : {n, n / 2, n / 3, opaque ? 255 : alpha})
          all.push_back(static_cast<std::uint8_t>(value));
    Picture other = all;
    for (std::size_t n = 0; n < other.size(); n += 128) other[n] = other[n] > 0 ? 0 : other[n + 3];
    EXPECT_EQ(mean({{all, 1}, {all, 2}, {all, 5}}, opaque), all);
    const Picture out = mean({{all, 2}, {other, 1}, {all, 5}}, opaque);
    for (std::size_t n = 0; n < all.size(); n += 4)
      for (std::size_t c = 0; n % 128 != 0 && c < 4; ++c)
        ASSERT_EQ(out[n + c], all[n + c]) << opaque << " " << n + c;
  }
}

// Half of the time a red pixel, half of the time nothing: red, and half transparent.
TEST(LightAverage, WhatIsNotThereCountsAsTransparentAndHasNoColour) {
  const Picture out = mean({{{200, 0, 0, 255}, 4}, {{0, 0, 0, 0}, 4}}, false);
  EXPECT_EQ(out, (Picture{100, 0, 0, 128})); // multiplied by alpha
}

} // namespace
} // namespace rend::light_average_test
