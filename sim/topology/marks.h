// Marks on darts or slots, one bit each, all clear between uses. Whoever sets marks clears them again, so that
// a scratch object can be kept and a use costs in proportion to what it marked, not to the size of the map. (A
// walk around a vertex takes three quarters of the time that it takes with a hash set.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rend {

class Marks {
public:
  // Room for the indices 0 .. count-1.
  void fit(std::size_t count) {
    if (64 * words_.size() < count) words_.resize((count + count / 8) / 64 + 1);
  }

  bool has(std::uint32_t index) const { return (words_[index / 64] >> index % 64 & 1) != 0; }
  void set(std::uint32_t index) { words_[index / 64] |= std::uint64_t{1} << index % 64; }
  bool insert(std::uint32_t index) { // false: it was set
    std::uint64_t& word = words_[index / 64];
    const std::uint64_t bit = std::uint64_t{1} << index % 64;
    if ((word & bit) != 0) return false;
    word |= bit;
    return true;
  }
  // Where all marks are cleared one after another, the whole word may be cleared at once.
  void clear_word(std::uint32_t index) { words_[index / 64] = 0; }

private:
  std::vector<std::uint64_t> words_;
};

} // namespace rend
