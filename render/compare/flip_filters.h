// The filters of FLIP, one-dimensional: each of the two-dimensional ones is a product of two of these, or a sum
// of two products. Borders repeat the outermost pixel.
#pragma once

#include <vector>

namespace rend {

struct Filter {
  std::vector<float> weights; // of the pixels −radius … radius
  int radius() const { return static_cast<int>(weights.size() / 2); }
};

// What the eye makes of colour at some pixels a degree: g(x, y) = Σ aᵢ √(π/bᵢ) exp(−π² (x² + y²)/bᵢ), (x, y in
// degrees), which sums to 1. Luminance and red-green are one Gaussian, blue-yellow two.
struct ColourFilters {
  Filter luminance, red_green, blue_narrow, blue_wide;
};
ColourFilters colour_filters(double pixels_per_degree);

// A Gaussian of the standard deviation 0.5 · 0.082 degrees, and its first and second derivatives. What is above
// 0 sums to 1 in each derivative, what is below to −1.
struct FeatureFilters {
  Filter gaussian, edge, point;
};
FeatureFilters feature_filters(double pixels_per_degree);

// out[x] = Σ weights[k] row[x + k]; `scratch` is for the function.
void filter_row(const Filter& filter, const float* row, int width, std::vector<float>& scratch, float* out);

// The same along columns, of row y of a plane.
void filter_column(const Filter& filter, const std::vector<float>& plane, int width, int height, int y,
                   float* out);

} // namespace rend
