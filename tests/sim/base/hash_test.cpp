#include "sim/base/hash.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace rend::hash_test {
namespace {

TEST(Hash, is_that_of_xxh3) { // test vectors of the algorithm
  EXPECT_EQ(hash_bytes("", 0), 0x2d06800538d394c2ULL);
}

TEST(Hash, tells_single_bits_apart) {
  std::string bytes(100, '\0');
  std::set<std::uint64_t> seen{hash_bytes(bytes.data(), bytes.size())};
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string other = bytes;
      other[n] = static_cast<char>(1 << bit);
      EXPECT_TRUE(seen.insert(hash_bytes(other.data(), other.size())).second);
    }
  }
}

TEST(Hash, depends_on_the_seed_and_on_the_order) {
  EXPECT_NE(hash_bytes("ab", 2, 0), hash_bytes("ab", 2, 1));
  EXPECT_NE(hash_bytes("b", 1, hash_bytes("a", 1)), hash_bytes("a", 1, hash_bytes("b", 1)));
}

} // namespace
} // namespace rend::hash_test
