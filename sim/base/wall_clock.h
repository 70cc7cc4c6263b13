// The wall clock, for figures of how long things took.
#pragma once

#include <chrono>

namespace rend {

// [s], since any moment; never goes back.
inline double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace rend
