// Large arrays in large pages: what the program asks for by operator new is aligned to pages of 2 MB from twice
// their size on, and the system is told so (madvise; a system that always or never gives large pages is not
// asked).
//
// Arrays of a body of a million elements are read in a row, once a step. With pages of 4 kB the processor looks
// up one page after another and its prefetchers stop at the end of each: in a virtual machine one thread read
// 12 GB/s, and 21 with large pages. Nothing is rounded up: what is left behind the last large page stays in
// small ones.
//
// Compiled into programs (rend, its benchmarks), not into the library: that leaves operator new to those who
// link it.
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

// An answer, and no end of the program: who asks so can do with less (std::stable_sort).
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocated(size);
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
