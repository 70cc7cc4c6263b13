// How often rend diff raises a false alarm under a stated noise, and how often it catches a crack that has
// moved: over 1000 random pictures each.
//
// The noise: each channel of each pixel is one level higher or lower with a probability of 5 %, as pictures of
// other processors were seen to be, and twice as often; and one pixel in 5000 differs by up to 64 levels, as at
// edges that are sampled otherwise. The crack is a dark line, 1.5 pixels wide and smoothed, that runs across
// the picture in random turns.
#include "render/compare/limits.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace rend::noise_test {
namespace {

constexpr int frame_width = 80, frame_height = 60, repeats = 1000;

class Noisy {
public:
  explicit Noisy(unsigned seed) : random_(seed) {
    double x = uniform(20, 60);
    for (double& at : crack_) at = x = std::clamp(x + uniform(-1.2, 1.2), 6.0, frame_width - 7.0);
  }

  // A shaded surface with the crack, moved by some pixels across.
  Picture picture(double moved) const {
    Picture out{.width = frame_width, .height = frame_height, .alpha = false, .planes = {}};
    for (std::size_t c = 0; c < 3; ++c) {
      out.planes[c].resize(out.pixels());
      for (int y = 0; y < frame_height; ++y)
        for (int x = 0; x < frame_width; ++x) {
          const double from_crack = std::abs(x - crack_[static_cast<std::size_t>(y)] - moved);
          const double share = std::clamp(1.25 - from_crack, 0.0, 1.0); // of the pixel that it covers
          const double shade = 150 + 40 * std::sin(0.06 * x + 0.04 * y) - 20 * static_cast<double>(c);
          out.planes[c][static_cast<std::size_t>(y * frame_width + x)] =
              static_cast<float>(std::round(shade * (1 - share) + 40 * share));
        }
    }
    return out;
  }

  Picture with_noise(Picture picture) {
    for (std::size_t n = 0; n < picture.pixels(); ++n) {
      const double jump = uniform(0, 1) < 1.0 / 5000 ? uniform(-64, 64) : 0;
      for (std::size_t c = 0; c < 3; ++c) {
        float& level = picture.planes[c][n];
        const double slight = uniform(0, 1) < 0.05 ? (uniform(0, 1) < 0.5 ? 1 : -1) : 0;
        level = std::clamp(level + static_cast<float>(std::round(jump) + slight), 0.f, 255.f);
      }
    }
    return picture;
  }

private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  std::mt19937 random_;
  std::array<double, frame_height> crack_{}; // [pixels], x in each row
};

// The tolerance of the README: render/README.md, "Comparing pictures".
Tolerance documented_tolerance() {
  return {.threshold = 8, .limits = {{"share", 0.002}}};
}

int alarms(double moved) {
  const Tolerance allowed = documented_tolerance();
  int count = 0;
  for (int n = 0; n < repeats; ++n) {
    Noisy noisy(static_cast<unsigned>(n));
    const Picture expected = noisy.picture(0), now = noisy.with_noise(noisy.picture(moved));
    const Metrics metrics = measure(expected, now, {}, {.threshold = allowed.threshold});
    count += !excesses(allowed, metrics).empty();
  }
  return count;
}

TEST(DiffUnderNoise, raises_a_false_alarm_in_at_most_one_of_a_hundred) {
  const int count = alarms(0);
  RecordProperty("false_alarms_of_1000", count);
  EXPECT_LE(count, repeats / 100);
}

TEST(DiffUnderNoise, catches_a_crack_that_has_moved_by_two_pixels) {
  const int count = alarms(2);
  RecordProperty("caught_of_1000", count);
  EXPECT_GE(count, repeats * 99 / 100);
}

TEST(DiffUnderNoise, reports_how_often_it_catches_a_crack_that_has_moved_by_one_pixel) {
  const int count = alarms(1);
  RecordProperty("caught_of_1000", count);
  EXPECT_GT(count, 0); // a statement, not a promise: in the README
}

} // namespace
} // namespace rend::noise_test
