#include "sim/topology/dart_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace rend::dart_sort_test {
namespace {

// Few and many keys, dense and over the whole range of 32 bits.
TEST(DartSort, sorts_as_a_comparing_sort_does) {
  std::mt19937 random(1);
  for (const std::size_t count : {0, 1, 2, 100, 255, 256, 5000}) {
    for (const std::uint32_t range : {6000u, 3000000u, 0xffffffffu}) {
      std::vector<std::uint64_t> keys;
      while (keys.size() < count) { // distinct darts
        for (std::size_t n = keys.size(); n < count; ++n)
          keys.push_back(std::uint64_t{random() % range} << 32 | n);
        std::sort(keys.begin(), keys.end());
        const auto same = [](std::uint64_t a, std::uint64_t b) { return a >> 32 == b >> 32; };
        keys.erase(std::unique(keys.begin(), keys.end(), same), keys.end());
      }
      std::vector<std::uint64_t> expected = keys;
      std::shuffle(keys.begin(), keys.end(), random);
      sort_by_dart(keys);
      EXPECT_EQ(keys, expected) << count << " of " << range;
    }
  }
}

} // namespace
} // namespace rend::dart_sort_test
