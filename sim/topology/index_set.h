// Sets and maps of indices (darts, slots) that are cleared in constant time, so that a scratch set can be kept
// between uses.
//
// Open addressing with linear probing, load at most one half. Fibonacci hashing: the bucket is taken from the
// high bits of the product with 2^32/φ, so that regular index patterns (each eighth dart, say) spread over the
// whole table.
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

  // Inserts `value` unless `index` is present; returns the value that is stored.
  std::uint32_t insert(std::uint32_t index, std::uint32_t value);
  void assign(std::uint32_t index, std::uint32_t value);
  void replace(std::uint32_t index, std::uint32_t value) noexcept; // of an index that is there
  std::uint32_t find(std::uint32_t index) const;                   // none: not there

private:
  struct Entry {
    std::uint32_t index = 0, value = 0, stamp = 0; // an entry of an older stamp is empty
  };
  Entry& place(std::uint32_t index); // the entry of `index`, or the one to insert it; grows first if needed
  std::size_t home(std::uint32_t index) const { return (index * golden) >> shift_; }
  void grow();

  static constexpr std::uint32_t golden = 0x9e3779b1u; // 2^32 / φ

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

inline IndexMap::Entry& IndexMap::place(std::uint32_t index) {
  if (2 * (size_ + 1) > table_.size()) grow();
  const std::size_t mask = table_.size() - 1;
  std::size_t at = home(index);
  while (table_[at].stamp == stamp_ && table_[at].index != index) at = (at + 1) & mask;
  return table_[at];
}

inline std::uint32_t IndexMap::insert(std::uint32_t index, std::uint32_t value) {
  Entry& entry = place(index);
  if (entry.stamp == stamp_) return entry.value;
  entry = {index, value, stamp_};
  ++size_;
  return value;
}

inline std::uint32_t IndexMap::find(std::uint32_t index) const {
  if (size_ == 0) return none;
  const std::size_t mask = table_.size() - 1;
  for (std::size_t at = home(index);; at = (at + 1) & mask) {
    const Entry& entry = table_[at];
    if (entry.stamp != stamp_) return none;
    if (entry.index == index) return entry.value;
  }
}

inline bool IndexSet::insert(std::uint32_t index) {
  const std::size_t before = map_.size();
  map_.insert(index, 0);
  return map_.size() != before;
}

} // namespace rend
