#include "render/compare/percentile.h"

#include "sim/base/check.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace rend {
namespace {

// The upper 16 bits of a float: monotonic for floats that are not negative.
std::uint32_t bucket_of(float value) {
  return std::bit_cast<std::uint32_t>(value) >> 16;
}

// The smallest of `values` (all in that bucket) at which the running sum, starting from `below`, reaches
// `wanted`.
float find(std::span<const float> values, std::uint32_t bucket, double below, double wanted) {
  std::vector<float> sorted;
  for (const float value : values)
    if (value > 0 && bucket_of(value) == bucket) sorted.push_back(value);
  std::sort(sorted.begin(), sorted.end());
  for (const float value : sorted) {
    below += value;
    if (below >= wanted) return value;
  }
  return sorted.back(); // the sum fell short by rounding
}

} // namespace

// A sum per bucket first: only the bucket that contains a percentile is sorted, which takes a tenth of the time
// of sorting everything.
std::vector<float> weighted_percentiles(std::span<const float> values, std::span<const double> percents) {
  std::vector<double> sums(std::size_t{1} << 15);
  for (const float value : values) {
    CHECK(value >= 0);
    sums[bucket_of(value)] += value;
  }
  double total = 0;
  for (const double sum : sums) total += sum;
  std::vector<float> out(percents.size());
  if (total <= 0) return out;
  std::size_t bucket = 0;
  double below = 0;
  for (std::size_t n = 0; n < percents.size(); ++n) {
    CHECK(percents[n] > 0 && percents[n] <= 100 && (n == 0 || percents[n] >= percents[n - 1]));
    const double wanted = total * (percents[n] / 100);
    while (below + sums[bucket] < wanted && bucket + 1 < sums.size()) below += sums[bucket++];
    out[n] = find(values, static_cast<std::uint32_t>(bucket), below, wanted);
  }
  return out;
}

} // namespace rend
