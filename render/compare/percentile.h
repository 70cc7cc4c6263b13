// Weighted percentiles: where the errors that matter lie.
//
// Every value weighs as much as it is large: the p-th weighted percentile is the least value v with
//
//   Σ (values ≤ v) ≥ p/100 · Σ (all values)
//
// A picture that differs in few pixels has a mean near 0, whatever happened there; weighted, the many zeros do
// not count. Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: FLIP: A Difference Evaluator for
// Alternating Images. Proc. ACM Comput. Graph. Interact. Tech. 3 (2020): there, for pooling.
#pragma once

#include <span>
#include <vector>

namespace rend {

// One value per entry of `percents` (each above 0, at most 100, growing: CHECK). `values`: none below 0. All 0
// where no value is above 0. Exact but for the rounding of the sums, whose order is that of the values.
std::vector<float> weighted_percentiles(std::span<const float> values, std::span<const double> percents);

} // namespace rend
