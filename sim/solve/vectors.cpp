#include "sim/solve/vectors.h"

#include "sim/base/threads.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr std::size_t block_records = 1024; // records

REND_INLINE double sum_products(const Record* a, const Record* b, std::size_t begin, std::size_t end) {
  Double4 even{}, odd{};
  std::size_t i = begin;
  for (; i + 1 < end; i += 2) {
    even += load(a[i]) * load(b[i]);
    odd += load(a[i + 1]) * load(b[i + 1]);
  }
  if (i < end) even += load(a[i]) * load(b[i]);
  const Double4 sum = even + odd;
  return sum[0] + sum[1] + sum[2];
}

REND_INLINE void add_scaled_range(double s, const Record* x, Record* y, std::size_t begin, std::size_t end) {
  const Double4 factor = splat(s);
  for (std::size_t i = begin; i < end; ++i) store(y[i], load(y[i]) + factor * load(x[i]));
}

REND_INLINE void scale_and_add_range(double s, const Record* x, Record* y, std::size_t begin, std::size_t end) {
  const Double4 factor = splat(s);
  for (std::size_t i = begin; i < end; ++i) store(y[i], load(x[i]) + factor * load(y[i]));
}

} // namespace

double largest_coordinate(const Records& x) {
  Double4 most{};
  for (const Record& r : x) {
    const Double4 v = load(r);
    for (int k = 0; k < 3; ++k) most[k] = std::max(most[k], std::abs(v[k]));
  }
  return std::max({most[0], most[1], most[2]});
}

double dot(int parts, const Records& a, const Records& b) {
  const std::size_t blocks = (a.size() + block_records - 1) / block_records;
  thread_local std::vector<double> partial;
  partial.assign(blocks, 0);
  double* const sums = partial.data();
  parallel_ranges(parts, blocks, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      sums[n] = at_width<sum_products>(a.data(), b.data(), n * block_records,
                                       std::min(a.size(), (n + 1) * block_records));
  });
  double sum = 0;
  for (double part : partial) sum += part;
  return sum;
}

void add_scaled(int parts, double s, const Records& x, Records& y) {
  parallel_ranges(parts, x.size(), [&](std::size_t begin, std::size_t end) {
    at_width<add_scaled_range>(s, x.data(), y.data(), begin, end);
  });
}

void scale_and_add(int parts, double s, const Records& x, Records& y) {
  parallel_ranges(parts, x.size(), [&](std::size_t begin, std::size_t end) {
    at_width<scale_and_add_range>(s, x.data(), y.data(), begin, end);
  });
}

} // namespace rend
