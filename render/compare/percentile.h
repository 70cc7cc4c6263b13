// Weighted percentiles, each value being its own weight.
//
// The p-th weighted percentile is the smallest value v with
//
//   Σ (values ≤ v) ≥ p/100 · Σ (all values)
//
// If only few pixels of a picture differ, the mean is near 0 however large the differences are; weighted, the
// many zeros do not count. Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: FLIP: A Difference
// Evaluator for Alternating Images. Proc. ACM Comput. Graph. Interact. Tech. 3 (2020): there, for pooling.
#pragma once

#include <span>
#include <vector>

namespace rend {

// One result per entry of `percents` (each above 0, at most 100, increasing: CHECK). `values` must not be
// negative. All results are 0 if all values are. Exact up to the rounding of the sums, which are taken in the
// order of the values.
std::vector<float> weighted_percentiles(std::span<const float> values, std::span<const double> percents);

} // namespace rend
