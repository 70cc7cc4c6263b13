// Differences, shares, windows, percentiles and masks, by brute force.
#include "render/compare/metrics.h"

#include "render/compare/percentile.h"
#include "tests/render/compare/plain_pictures.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace rend::metrics_test {
namespace {

using namespace test;

TEST(Difference, is_what_its_formulas_say) {
  const Picture a = noise(37, 21, 1), b = noise(37, 21, 2);
  for (const PixelMask& mask : {PixelMask{}, every(a, 2), every(a, 5)}) {
    double sum = 0, squares = 0, most = 0, count = 0;
    for (std::size_t n = 0; n < a.pixels(); ++n)
      for (std::size_t c = 0; c < 3 && mask[n]; ++c) {
        const double d = std::abs(static_cast<double>(a.planes[c][n]) - b.planes[c][n]);
        sum += d;
        squares += d * d;
        most = std::max(most, d);
        ++count;
      }
    const Difference found = difference_of(a, b, mask, 3);
    EXPECT_EQ(found.max, most);
    EXPECT_NEAR(found.mean, sum / count, 1e-12);
    EXPECT_NEAR(found.rmse, std::sqrt(squares / count), 1e-12);
    EXPECT_NEAR(found.psnr, 10 * std::log10(255 * 255 / (squares / count)), 1e-12);
    const std::size_t at = static_cast<std::size_t>(found.worst.y) * 37 + found.worst.x;
    EXPECT_EQ(found.largest[at], most);
  }
}

TEST(Window, is_the_densest_of_all) {
  std::mt19937 random(3);
  for (int turn = 0; turn < 60; ++turn) {
    const int width = 1 + static_cast<int>(random() % 24), height = 1 + static_cast<int>(random() % 24),
              side = 1 + static_cast<int>(random() % 12);
    Difference difference;
    difference.counted = static_cast<std::size_t>(width) * height;
    for (std::size_t n = 0; n < difference.counted; ++n)
      difference.largest.push_back(random() % 6 == 0 ? 9.f : 2.f);
    const int across = std::min(side, width), down = std::min(side, height);
    int most = 0;
    Pixel first;
    for (int y = 0; y + down <= height; ++y)
      for (int x = 0; x + across <= width; ++x) {
        int sum = 0;
        for (int j = y; j < y + down; ++j)
          for (int i = x; i < x + across; ++i)
            sum += difference.largest[static_cast<std::size_t>(j) * width + i] > 4 ? 1 : 0;
        if (sum > most) {
          most = sum;
          first = {x, y};
        }
      }
    const OverThreshold found = over_threshold(difference, width, height, 4, side);
    EXPECT_DOUBLE_EQ(found.dense, static_cast<double>(most) / (across * down));
    EXPECT_EQ(found.corner.x, first.x);
    EXPECT_EQ(found.corner.y, first.y);
    EXPECT_EQ(found.pixels,
              static_cast<std::size_t>(std::count(difference.largest.begin(), difference.largest.end(), 9.f)));
  }
}

TEST(Window, in_which_a_map_is_brightest_is_where_its_sum_is_largest) {
  Levels map(30 * 20);
  for (std::size_t n = 0; n < map.size(); ++n) map[n] = n % 7 == 0 ? 0.25f : 0.f;
  for (int y = 12; y < 16; ++y)
    for (int x = 21; x < 25; ++x) map[static_cast<std::size_t>(y * 30 + x)] = 1;
  const Pixel corner = brightest_window(map, 30, 20, 4);
  EXPECT_EQ(corner.x, 21);
  EXPECT_EQ(corner.y, 12);
  const Pixel whole = brightest_window(map, 30, 20, 64);
  EXPECT_EQ(whole.x + whole.y, 0);
}

TEST(WeightedPercentiles, are_those_of_the_sorted_values) {
  std::mt19937 random(4);
  const double percents[] = {1, 25, 50, 75, 99.5, 100};
  for (int turn = 0; turn < 40; ++turn) {
    std::vector<float> values(1 + random() % 500);
    // Multiples of 1/1024: their sums are exact in any order.
    for (float& value : values) value = static_cast<float>(random() % (turn % 2 ? 1024 : 4)) / 1024;
    std::vector<float> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    double total = 0;
    for (const float value : sorted) total += value;
    const std::vector<float> found = weighted_percentiles(values, percents);
    for (std::size_t n = 0; n < found.size(); ++n) {
      double sum = 0;
      float expected = 0;
      for (const float value : sorted) {
        sum += value;
        expected = value;
        if (sum >= total * (percents[n] / 100)) break;
      }
      EXPECT_EQ(found[n], total > 0 ? expected : 0) << percents[n] << " of " << values.size();
    }
  }
}

TEST(Mask, leaves_out_pixels_and_what_they_would_do_to_others) {
  const Picture a = noise(40, 40, 1);
  Picture b = a;
  PixelMask mask;
  mask.counts.assign(a.pixels(), 1);
  for (std::size_t n = 0; n < 800; n += 7) {
    b.planes[1][n] = 255 - b.planes[1][n];
    mask.counts[n] = 0;
  }
  const Metrics metrics = measure(a, b, mask, {});
  EXPECT_EQ(metrics.difference.max, 0);
  EXPECT_EQ(metrics.ssim, 1);
  EXPECT_EQ(metrics.flip.max, 0);
  EXPECT_GT(measure(a, b, {}, {}).flip.max, 0.1);
}

TEST(Transparency, counts_as_far_as_it_is_seen) {
  Picture clear = flat(8, 8, 0), other = flat(8, 8, 0); // transparent black, and transparent red
  HighDepthImage red;
  red.width = red.height = 8;
  red.channels = 4;
  for (int n = 0; n < 64; ++n) red.samples.insert(red.samples.end(), {255, 0, 0, 0});
  add_alpha(clear);
  clear.planes[3].assign(64, 0);
  EXPECT_EQ(measure(clear, picture_of(red), {}, {}).difference.max, 0);
  // Opaque black without an alpha channel equals opaque black with one, but not transparent black.
  add_alpha(other);
  EXPECT_EQ(measure(flat(8, 8, 0), other, {}, {}).difference.max, 0);
  EXPECT_EQ(measure(flat(8, 8, 0), clear, {}, {}).difference.max, 255);
  // black against the white background
  EXPECT_NEAR(measure(flat(8, 8, 0), clear, {}, {}).flip.mean, 0.967380, 5e-5);
}

} // namespace
} // namespace rend::metrics_test
