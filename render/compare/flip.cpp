#include "render/compare/flip.h"

#include "render/compare/flip_colour.h"
#include "render/compare/flip_filters.h"
#include "sim/base/check.h"
#include "sim/base/stop_request.h"
#include "sim/base/threads.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace rend {
namespace {

using Row = std::vector<float>;

// One picture after the horizontal filter pass.
struct Filtered {
  // The channels of YCxCz: luminance, red-green, and blue-yellow with either Gaussian.
  Levels luminance, red_green, blue_narrow, blue_wide;
  // Luminance, 0 to 1, after each of the feature filters.
  Levels gaussian, edge, point;

  explicit Filtered(std::size_t pixels)
      : luminance(pixels), red_green(pixels), blue_narrow(pixels), blue_wide(pixels), gaussian(pixels),
        edge(pixels), point(pixels) {}
};

class Flip {
public:
  Flip(const Picture& a, const Picture& b)
      : width_(a.width),
        height_(a.height), pictures_{&a, &b}, filtered_{Filtered(a.pixels()), Filtered(a.pixels())} {
    for (int level = 0; level < 256; ++level) linear_[level] = linear_of(static_cast<float>(level));
    const float largest = hyab(hunt_lab_of({0, 1, 0}), hunt_lab_of({0, 0, 1})); // green against blue
    most_ = std::pow(largest, 0.7f);
  }

  void along_rows(std::size_t picture, int y);
  // vertical pass; after along_rows() for all rows of both pictures
  void along_columns(int y, float* out) const;

private:
  struct Seen { // one row of one picture after both passes
    std::vector<Colour3> lab;
    Row edges, points; // magnitudes of the gradients
  };
  Seen seen(const Filtered& filtered, int y) const;
  float linear(float level) const {
    const auto whole = static_cast<int>(level);
    return static_cast<float>(whole) == level ? linear_[static_cast<std::size_t>(whole)] : linear_of(level);
  }
  float colour_error(const Colour3& a, const Colour3& b) const;

  int width_, height_;
  std::array<const Picture*, 2> pictures_;
  std::array<Filtered, 2> filtered_;
  std::array<float, 256> linear_{};
  float most_; // the largest colour difference, to the power 0.7
  ColourFilters colours_ = colour_filters(pixels_per_degree);
  FeatureFilters features_ = feature_filters(pixels_per_degree);
};

void Flip::along_rows(std::size_t picture, int y) {
  const Picture& from = *pictures_[picture];
  Filtered& to = filtered_[picture];
  const std::size_t start = static_cast<std::size_t>(y) * width_;
  Row luma(static_cast<std::size_t>(width_)), cx(luma.size()), cz(luma.size()), scratch;
  for (std::size_t x = 0; x < luma.size(); ++x) {
    const auto level = [&](std::size_t c) { return linear(from.planes[c][start + x]); };
    const Colour3 ycxcz = ycxcz_of({level(0), level(1), level(2)});
    luma[x] = ycxcz[0];
    cx[x] = ycxcz[1];
    cz[x] = ycxcz[2];
  }
  const auto filter = [&](const Filter& by, const Row& row, Levels& out) {
    filter_row(by, row.data(), width_, scratch, out.data() + start);
  };
  filter(colours_.luminance, luma, to.luminance);
  filter(colours_.red_green, cx, to.red_green);
  filter(colours_.blue_narrow, cz, to.blue_narrow);
  filter(colours_.blue_wide, cz, to.blue_wide);
  for (float& value : luma) value = (value + 16) / 116;
  filter(features_.gaussian, luma, to.gaussian);
  filter(features_.edge, luma, to.edge);
  filter(features_.point, luma, to.point);
}

Flip::Seen Flip::seen(const Filtered& filtered, int y) const {
  const auto width = static_cast<std::size_t>(width_);
  const auto column = [&](const Filter& by, const Levels& plane) {
    Row out(width);
    filter_column(by, plane, width_, height_, y, out.data());
    return out;
  };
  const Row luma = column(colours_.luminance, filtered.luminance),
            cx = column(colours_.red_green, filtered.red_green),
            narrow = column(colours_.blue_narrow, filtered.blue_narrow),
            wide = column(colours_.blue_wide, filtered.blue_wide);
  Seen out{std::vector<Colour3>(width), column(features_.gaussian, filtered.edge),
           column(features_.gaussian, filtered.point)};
  const Row edge = column(features_.edge, filtered.gaussian),
            point = column(features_.point, filtered.gaussian);
  for (std::size_t x = 0; x < width; ++x) {
    out.lab[x] = hunt_lab_of(linear_of_ycxcz({luma[x], cx[x], narrow[x] + wide[x]}));
    out.edges[x] = std::sqrt(out.edges[x] * out.edges[x] + edge[x] * edge[x]);
    out.points[x] = std::sqrt(out.points[x] * out.points[x] + point[x] * point[x]);
  }
  return out;
}

// 0 to 1: up to 0.4 of the largest difference takes up 0.95 of the range.
float Flip::colour_error(const Colour3& a, const Colour3& b) const {
  constexpr float knee = 0.4f, share = 0.95f;
  const float error = std::pow(hyab(a, b), 0.7f), at = knee * most_;
  return error < at ? error * (share / at) : share + (error - at) / (most_ - at) * (1 - share);
}

void Flip::along_columns(int y, float* out) const {
  const Seen a = seen(filtered_[0], y), b = seen(filtered_[1], y);
  for (std::size_t x = 0; x < a.lab.size(); ++x) {
    const float feature =
        std::max(std::abs(a.edges[x] - b.edges[x]), std::abs(a.points[x] - b.points[x])) / std::sqrt(2.f);
    const float colour = a.lab[x] == b.lab[x] ? 0.f : colour_error(a.lab[x], b.lab[x]);
    const float exponent = 1 - std::clamp(std::sqrt(feature), 0.f, 1.f);
    out[x] = colour == 0 && exponent > 0 ? 0.f : std::pow(colour, exponent);
  }
}

} // namespace

Levels flip_map(const Picture& a, const Picture& b, int threads) {
  CHECK(a.width == b.width && a.height == b.height && !a.alpha && !b.alpha);
  Flip flip(a, b);
  const auto height = static_cast<std::size_t>(a.height);
  parallel_ranges(threads, 2 * height, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      throw_if_stop_is_due();
      flip.along_rows(n % 2, static_cast<int>(n / 2));
    }
  });
  Levels map(a.pixels());
  parallel_ranges(threads, height, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      throw_if_stop_is_due();
      flip.along_columns(static_cast<int>(y), map.data() + y * static_cast<std::size_t>(a.width));
    }
  });
  return map;
}

} // namespace rend
