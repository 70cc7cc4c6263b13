#include "sim/topology/index_set.h"

#include <algorithm>

namespace rend {

void IndexMap::clear() {
  size_ = 0;
  if (++stamp_ == 0) { // the counter wrapped around: old stamps would look new
    std::fill(table_.begin(), table_.end(), Entry{});
    stamp_ = 1;
  }
}

void IndexMap::grow() {
  std::vector<Entry> old(std::max<std::size_t>(64, table_.size() * 2));
  old.swap(table_);
  shift_ = 32;
  for (std::size_t n = table_.size(); n > 1; n /= 2) --shift_;
  for (const Entry& entry : old)
    if (entry.stamp == stamp_) place(entry.index) = entry;
}

void IndexMap::assign(std::uint32_t index, std::uint32_t value) {
  Entry& entry = place(index);
  if (entry.stamp != stamp_) ++size_;
  entry = {index, value, stamp_};
}

void IndexMap::replace(std::uint32_t index, std::uint32_t value) noexcept {
  const std::size_t mask = table_.size() - 1;
  std::size_t at = home(index);
  while (table_[at].index != index || table_[at].stamp != stamp_) at = (at + 1) & mask;
  table_[at].value = value;
}

} // namespace rend
