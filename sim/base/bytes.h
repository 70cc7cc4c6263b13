// What an array holds, in bytes: what was written to. Room that is reserved for later costs addresses, and no
// memory.
#pragma once

#include <cstddef>
#include <vector>

namespace rend {

template <class T> std::size_t bytes_of(const std::vector<T>& array) {
  return array.size() * sizeof(T);
}

} // namespace rend
