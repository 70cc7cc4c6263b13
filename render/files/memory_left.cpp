#include "render/files/memory_left.h"

#include "sim/base/error.h"

#include <sys/mman.h>

namespace rend {

bool is_memory_left(std::size_t bytes) {
  void* const room = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) return false;
  ::munmap(room, bytes);
  return true;
}

void refuse_without_memory() {
  throw UserError(
      Exit::OutOfBudget, {}, "there is not enough memory to draw pictures",
      "draw smaller ones, take fewer samples (--set image.samples=1), or allow more memory (ulimit -v)");
}

} // namespace rend
