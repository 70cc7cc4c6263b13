// The bytes of memory that an array uses: its elements, without reserved capacity, whose pages the system does
// not provide before they are written.
#pragma once

#include <cstddef>
#include <vector>

namespace rend {

template <class T> std::size_t bytes_of(const std::vector<T>& array) {
  return array.size() * sizeof(T);
}

} // namespace rend
