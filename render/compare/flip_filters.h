// The one-dimensional filters of FLIP: each two-dimensional filter is a product of two of these, or a sum of
// two products. Border pixels are repeated outwards.
#pragma once

#include <vector>

namespace rend {

struct Filter {
  std::vector<float> weights; // of the pixels −radius … radius
  int radius() const { return static_cast<int>(weights.size() / 2); }
};

// Contrast sensitivity of the eye at a number of pixels per degree: g(x, y) = Σ aᵢ √(π/bᵢ) exp(−π² (x² +
// y²)/bᵢ), (x, y in degrees), which sums to 1. Luminance and red-green are one Gaussian, blue-yellow two.
struct ColourFilters {
  Filter luminance, red_green, blue_narrow, blue_wide;
};
ColourFilters colour_filters(double pixels_per_degree);

// A Gaussian with standard deviation 0.5 · 0.082 degrees, and its first and second derivatives. In each
// derivative the positive weights sum to 1 and the negative ones to −1.
struct FeatureFilters {
  Filter gaussian, edge, point;
};
FeatureFilters feature_filters(double pixels_per_degree);

// out[x] = Σ weights[k] row[x + k]; `scratch` is working memory.
void filter_row(const Filter& filter, const float* row, int width, std::vector<float>& scratch, float* out);

// The same along columns, of row y of a plane.
void filter_column(const Filter& filter, const std::vector<float>& plane, int width, int height, int y,
                   float* out);

} // namespace rend
