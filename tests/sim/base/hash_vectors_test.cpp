// The sanity values that the reference implementation of XXH3 is published with.
#include "sim/base/hash.h"

#include <gtest/gtest.h>
#include <vector>

namespace rend::hash_vectors_test {
namespace {

std::vector<unsigned char> sanity_buffer(std::size_t bytes) {
  std::vector<unsigned char> data(bytes);
  std::uint64_t generator = 2654435761U;
  for (unsigned char& byte : data) {
    byte = static_cast<unsigned char>(generator >> 56);
    generator *= 11400714785074694797ULL;
  }
  return data;
}

TEST(Hash, has_the_reference_values_of_every_length_class) {
  struct Known {
    std::size_t bytes;
    std::uint64_t seed, hash;
  };
  for (const Known& known :
       {Known{0, 0, 0x2D06800538D394C2ULL}, Known{0, 0x9E3779B185EBCA8DULL, 0xA8A6B918B2F0364AULL},
        Known{1, 0, 0xC44BDFF4074EECDBULL}, Known{6, 0, 0x27B56A84CD2D7325ULL},
        Known{12, 0, 0xA713DAF0DFBB77E7ULL}, Known{24, 0, 0xA3FE70BF9D3510EBULL},
        Known{48, 0, 0x397DA259ECBA1F11ULL}, Known{80, 0, 0xBCDEFBBB2C47C90AULL},
        Known{195, 0, 0xCD94217EE362EC3AULL}, Known{403, 0, 0xCDEB804D65C6DEA4ULL},
        Known{512, 0, 0x617E49599013CB6BULL}, Known{2048, 0, 0xDD59E2C3A5F038E0ULL},
        Known{2240, 0, 0x6E73A90539CF2948ULL}, Known{2367, 0, 0xCB37AEB9E5D361EDULL}})
    EXPECT_EQ(hash_bytes(sanity_buffer(known.bytes).data(), known.bytes, known.seed), known.hash)
        << known.bytes << " bytes";
}

TEST(Hash, does_not_depend_on_alignment) {
  const std::vector<unsigned char> data = sanity_buffer(300);
  for (std::size_t shift = 0; shift < 33; ++shift) {
    std::vector<unsigned char> moved(shift, 0xaa);
    moved.insert(moved.end(), data.begin(), data.end());
    EXPECT_EQ(hash_bytes(moved.data() + shift, data.size()), hash_bytes(data.data(), data.size()));
  }
}

} // namespace
} // namespace rend::hash_vectors_test
