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
  std::vector<Entry> old;
  old.swap(table_);
  table_.resize(std::max<std::size_t>(64, old.size() * 2));
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

} // namespace rend
