#include "sim/topology/index_set.h"

#include <algorithm>

namespace rend {
namespace {
constexpr std::uint32_t golden = 0x9e3779b1u; // 2^32 / φ
} // namespace

void IndexMap::clear() {
  size_ = 0;
  if (++stamp_ == 0) { // counted once around: old stamps would look new
    std::fill(table_.begin(), table_.end(), Entry{});
    stamp_ = 1;
  }
}

void IndexMap::grow() {
  std::vector<Entry> old;
  old.swap(table_);
  table_.resize(std::max<std::size_t>(64, old.size() * 2));
  shift_ = 32;
  for (std::size_t n = table_.size(); n > 1; n /= 2) --shift_;
  for (const Entry& entry : old)
    if (entry.stamp == stamp_) place(entry.index) = entry;
}

IndexMap::Entry& IndexMap::place(std::uint32_t index) {
  if (2 * (size_ + 1) > table_.size()) grow();
  const std::size_t mask = table_.size() - 1;
  std::size_t at = (index * golden) >> shift_;
  while (table_[at].stamp == stamp_ && table_[at].index != index) at = (at + 1) & mask;
  return table_[at];
}

std::uint32_t IndexMap::insert(std::uint32_t index, std::uint32_t value) {
  Entry& entry = place(index);
  if (entry.stamp == stamp_) return entry.value;
  entry = {index, value, stamp_};
  ++size_;
  return value;
}

void IndexMap::assign(std::uint32_t index, std::uint32_t value) {
  Entry& entry = place(index);
  if (entry.stamp != stamp_) ++size_;
  entry = {index, value, stamp_};
}

std::uint32_t IndexMap::find(std::uint32_t index) const {
  if (size_ == 0) return none;
  const std::size_t mask = table_.size() - 1;
  for (std::size_t at = (index * golden) >> shift_;; at = (at + 1) & mask) {
    const Entry& entry = table_[at];
    if (entry.stamp != stamp_) return none;
    if (entry.index == index) return entry.value;
  }
}

bool IndexSet::insert(std::uint32_t index) {
  const std::size_t before = map_.size();
  map_.insert(index, 0);
  return map_.size() != before;
}

} // namespace rend
