#include "render/compare/memory_budget.h"

#include "sim/base/check.h"

#include <algorithm>

namespace rend {

std::size_t MemoryBudget::of_machine(std::size_t available) {
  return std::min(most_compared_bytes, available / 4 * 3);
}

MemoryBudget::Share MemoryBudget::take(std::size_t bytes) {
  CHECK(bytes <= whole_);
  std::unique_lock lock(mutex_);
  given_back_.wait(lock, [&] { return bytes <= left_; });
  left_ -= bytes;
  return {*this, bytes};
}

void MemoryBudget::give_back(std::size_t bytes) {
  {
    const std::lock_guard lock(mutex_);
    left_ += bytes;
  }
  given_back_.notify_all();
}

} // namespace rend
