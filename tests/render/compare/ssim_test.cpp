// SSIM against its formula, window by window. (Against scikit-image: tests/compare/recompute.py.)
#include "render/compare/ssim.h"

#include "tests/render/compare/plain_pictures.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace rend::ssim_test {
namespace {

using namespace test;

// One window in two passes: means first, then squared deviations.
double of_window(const Picture& a, const Picture& b, std::size_t c, int x, int y, int across, int down) {
  const double n = across * down;
  const auto mean = [&](const auto& value) {
    double sum = 0;
    for (int j = y; j < y + down; ++j)
      for (int i = x; i < x + across; ++i) sum += value(static_cast<std::size_t>(j) * a.width + i);
    return sum / n;
  };
  const auto p = [&](std::size_t k) { return static_cast<double>(a.planes[c][k]); };
  const auto q = [&](std::size_t k) { return static_cast<double>(b.planes[c][k]); };
  const double mp = mean(p), mq = mean(q), norm = n > 1 ? n / (n - 1) : 1;
  const double vp = norm * mean([&](std::size_t k) { return (p(k) - mp) * (p(k) - mp); });
  const double vq = norm * mean([&](std::size_t k) { return (q(k) - mq) * (q(k) - mq); });
  const double vpq = norm * mean([&](std::size_t k) { return (p(k) - mp) * (q(k) - mq); });
  const double c1 = 6.5025, c2 = 58.5225;
  return (2 * mp * mq + c1) * (2 * vpq + c2) / ((mp * mp + mq * mq + c1) * (vp + vq + c2));
}

double by_windows(const Picture& a, const Picture& b, const PixelMask& mask) {
  const int across = std::min(7, a.width), down = std::min(7, a.height);
  double sum = 0;
  int count = 0;
  for (std::size_t c = 0; c < 3; ++c)
    for (int y = 0; y + down <= a.height; ++y)
      for (int x = 0; x + across <= a.width; ++x) {
        if (!mask[static_cast<std::size_t>(y + down / 2) * a.width + x + across / 2]) continue;
        sum += of_window(a, b, c, x, y, across, down);
        ++count;
      }
  return count > 0 ? sum / count : 1;
}

TEST(Ssim, is_the_mean_of_its_formula_over_all_windows) {
  const int sizes[][2] = {{31, 23}, {7, 7}, {8, 30}, {5, 40}, {40, 3}, {1, 1}, {2, 1}};
  for (const auto& [width, height] : sizes) {
    const Picture a = noise(width, height, 1);
    Picture b = noise(width, height, 2);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t n = 0; n < a.pixels(); ++n)
        b.planes[c][n] = 0.7f * a.planes[c][n] + 0.3f * b.planes[c][n];
    EXPECT_NEAR(ssim_of(a, b, {}, 1), by_windows(a, b, {}), 1e-12) << width << " x " << height;
    EXPECT_NEAR(ssim_of(a, b, every(a, 3), 1), by_windows(a, b, every(a, 3)), 1e-12)
        << width << " x " << height;
  }
}

TEST(Ssim, of_flat_pictures_is_known) {
  EXPECT_NEAR(ssim_of(flat(20, 20, 128), flat(20, 20, 136), {}, 1), 0.998165, 1e-6);
  EXPECT_NEAR(ssim_of(flat(20, 20, 0), flat(20, 20, 255), {}, 1), 9.999e-5, 1e-8);
  EXPECT_EQ(ssim_of(noise(20, 20, 1), noise(20, 20, 1), {}, 1), 1);
}

TEST(Ssim, is_the_same_on_any_number_of_threads) {
  const Picture a = noise(61, 47, 1), b = noise(61, 47, 2);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(ssim_of(a, b, {}, 1), ssim_of(a, b, {}, threads));
}

} // namespace
} // namespace rend::ssim_test
