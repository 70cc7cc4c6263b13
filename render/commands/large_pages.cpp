// Large arrays in huge pages: allocations by operator new of at least 4 MB are aligned to 2 MB, and huge pages
// are requested with madvise (no effect where the system always or never gives them).
//
// Arrays of a body of a million elements are streamed once a step. With 4 kB pages there are many TLB misses,
// and the prefetchers stop at the end of each page: in a virtual machine one thread read 12 GB/s, and 21 with
// huge pages. Sizes are not rounded up: the remainder after the last huge page lies in small pages.
//
// Compiled into programs (rend, its benchmarks), not into the library: replacing operator new is left to the
// program that links it.
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace {

constexpr std::size_t page = std::size_t{2} << 20, least = 2 * page; // [bytes]

void* allocated(std::size_t size) noexcept {
#ifdef __linux__
  if (size >= least) {
    void* memory = nullptr;
    if (posix_memalign(&memory, page, size) != 0) return nullptr;
    madvise(memory, size / page * page, MADV_HUGEPAGE);
    return memory;
  }
#endif
  return std::malloc(size > 0 ? size : 1);
}

} // namespace

void* operator new(std::size_t size) {
  while (true) {
    if (void* memory = allocated(size)) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (!handler) throw std::bad_alloc();
    handler();
  }
}

// Returns null instead of ending the program: such callers can do with less (std::stable_sort).
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocated(size);
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
