// The wall clock, for measuring run times.
#pragma once

#include <chrono>

namespace rend {

// [s] since an arbitrary moment; monotonic.
inline double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace rend
