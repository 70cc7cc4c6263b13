#include "sim/topology/dart_sort.h"

#include <algorithm>
#include <array>

namespace rend {

// Few keys by comparison, many by radix sort from the lowest digit (Knuth 5.2.5), skipping digits that are 0 in
// all darts.
void sort_by_dart(std::vector<std::uint64_t>& keys) {
  if (std::is_sorted(keys.begin(), keys.end())) return;
  if (keys.size() < 256) return std::sort(keys.begin(), keys.end());
  constexpr int bits = 11;
  constexpr std::size_t digits = std::size_t{1} << bits;
  thread_local std::vector<std::uint64_t> sorted;
  const std::uint64_t most = *std::max_element(keys.begin(), keys.end()) >> 32;
  for (int shift = 0; shift < 32 && most >> shift != 0; shift += bits) {
    const auto digit = [&](std::uint64_t key) { return (key >> (32 + shift)) % digits; };
    std::array<std::uint32_t, digits + 1> begin{};
    for (const std::uint64_t key : keys) ++begin[digit(key) + 1];
    for (std::size_t n = 0; n < digits; ++n) begin[n + 1] += begin[n];
    sorted.resize(keys.size());
    for (const std::uint64_t key : keys) sorted[begin[digit(key)]++] = key;
    keys.swap(sorted);
  }
}

} // namespace rend
