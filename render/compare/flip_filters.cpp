#include "render/compare/flip_filters.h"

#include "sim/base/math.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

// exp(−factor x²) at −radius … radius.
std::vector<double> gaussian(double factor, int radius) {
  std::vector<double> out;
  for (int x = -radius; x <= radius; ++x) out.push_back(std::exp(-factor * x * x));
  return out;
}

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

Filter scaled(const std::vector<double>& values, double factor) {
  Filter filter;
  for (const double value : values) filter.weights.push_back(static_cast<float>(value * factor));
  return filter;
}

// Scales the positive weights to the sum 1, the negative ones to −1.
Filter balanced(const std::vector<double>& values) {
  double above = 0, below = 0;
  for (const double value : values) (value > 0 ? above : below) += std::abs(value);
  Filter filter;
  for (const double value : values)
    filter.weights.push_back(static_cast<float>(value / (value > 0 ? above : below)));
  return filter;
}

} // namespace

ColourFilters colour_filters(double per_degree) {
  // Constants of the paper's table 1: a and b of the one or two Gaussians.
  constexpr double luminance = 0.0047, red_green = 0.0053;
  constexpr double a1 = 34.1, blue1 = 0.04, a2 = 13.5, blue2 = 0.025;
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(blue1 / (2 * pi * pi)) * per_degree));
  const auto of = [&](double b) { return gaussian(pi * pi / (b * per_degree * per_degree), radius); };
  const auto one = [&](double b) {
    const std::vector<double> values = of(b);
    return scaled(values, 1 / sum_of(values));
  };
  const std::vector<double> wide = of(blue1), narrow = of(blue2);
  const double height1 = a1 * std::sqrt(pi / blue1), height2 = a2 * std::sqrt(pi / blue2);
  const double all =
      height1 * sum_of(wide) * sum_of(wide) + height2 * sum_of(narrow) * sum_of(narrow); // over the plane
  return {one(luminance), one(red_green), scaled(narrow, std::sqrt(height2 / all)),
          scaled(wide, std::sqrt(height1 / all))};
}

FeatureFilters feature_filters(double per_degree) {
  constexpr double width = 0.082; // [degrees], of what counts as an edge
  const double deviation = 0.5 * width * per_degree;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  const std::vector<double> base = gaussian(1 / (2 * deviation * deviation), radius);
  std::vector<double> first = base, second = base;
  for (int x = -radius; x <= radius; ++x) {
    const auto n = static_cast<std::size_t>(x + radius);
    first[n] *= -x;
    second[n] *= x * x / (deviation * deviation) - 1;
  }
  return {scaled(base, 1 / sum_of(base)), balanced(first), balanced(second)};
}

void filter_row(const Filter& filter, const float* row, int width, std::vector<float>& scratch, float* out) {
  const int radius = filter.radius();
  scratch.resize(static_cast<std::size_t>(width + 2 * radius));
  std::fill_n(scratch.begin(), radius, row[0]);
  std::copy_n(row, width, scratch.begin() + radius);
  std::fill_n(scratch.end() - radius, radius, row[width - 1]);
  std::fill_n(out, width, 0.f);
  for (std::size_t k = 0; k < filter.weights.size(); ++k) {
    const float weight = filter.weights[k];
    const float* from = scratch.data() + k;
    for (int x = 0; x < width; ++x) out[x] += weight * from[x];
  }
}

void filter_column(const Filter& filter, const std::vector<float>& plane, int width, int height, int y,
                   float* out) {
  const int radius = filter.radius();
  std::fill_n(out, width, 0.f);
  for (int k = -radius; k <= radius; ++k) {
    const float weight = filter.weights[static_cast<std::size_t>(k + radius)];
    const float* from = plane.data() + static_cast<std::size_t>(std::clamp(y + k, 0, height - 1)) * width;
    for (int x = 0; x < width; ++x) out[x] += weight * from[x];
  }
}

} // namespace rend
