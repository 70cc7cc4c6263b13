// Sets and maps of indices (darts, slots) that are emptied in constant time, so that a scratch one can be kept.
//
// Open addressing with linear probing, at most half full. The home of an index is taken from the high bits of a
// product with 2^32/φ: every low-bit pattern (each eighth dart, say) spreads over the whole table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rend {

class IndexMap {
public:
  static constexpr std::uint32_t none = 0xffffffffu;

  void clear();
  std::size_t size() const { return size_; }

  // The value of `index`, which is `value` if it was not there before.
  std::uint32_t insert(std::uint32_t index, std::uint32_t value);
  void assign(std::uint32_t index, std::uint32_t value);
  std::uint32_t find(std::uint32_t index) const; // none: not there

private:
  struct Entry {
    std::uint32_t index = 0, value = 0, stamp = 0; // of an older stamp: empty
  };
  Entry& place(std::uint32_t index); // where it is, or would be; makes room for one more
  void grow();

  std::vector<Entry> table_; // size a power of two
  std::size_t size_ = 0;
  std::uint32_t stamp_ = 1;
  int shift_ = 32; // 32 - log2(size of the table)
};

class IndexSet {
public:
  void clear() { map_.clear(); }
  bool insert(std::uint32_t index); // false: it was there
  bool contains(std::uint32_t index) const { return map_.find(index) != IndexMap::none; }

private:
  IndexMap map_;
};

} // namespace rend
