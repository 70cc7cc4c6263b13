#include "sim/allocations.h"

#include <dlfcn.h>
#include <execinfo.h>
#include <fmt/format.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>

namespace rend::allocations {
namespace {

constexpr int deepest = 24;
std::atomic<bool> looking{false};
std::atomic<long> asked{0};
std::array<void*, deepest> first{}; // the call stack of the first allocation
int first_depth = 0;
} // namespace

void note(void* caller);

// `caller`: the return address of malloc or operator new. Neither this function nor its callers may be inlined,
// since `first` records their callers.
__attribute__((noinline)) void note(void* caller) {
  if (!looking.load(std::memory_order_relaxed)) return;
  Dl_info info;
  if (dladdr(caller, &info) != 0 && info.dli_fname && std::strstr(info.dli_fname, "libtbb")) return;
  if (asked.fetch_add(1) == 0) first_depth = backtrace(first.data(), deepest);
}

long in(const std::function<void()>& work) {
  std::array<void*, 1> any;
  backtrace(any.data(), 1); // the first call of backtrace() loads libraries
  first_depth = 0;
  asked = 0;
  looking = true;
  work();
  looking = false;
  return asked;
}

std::string who() {
  std::string text = "asked first at";
  for (int n = 0; n < first_depth; ++n) {
    Dl_info info;
    void* at = first[static_cast<std::size_t>(n)];
    if (dladdr(at, &info) == 0) continue;
    const std::string file = info.dli_fname;
    const auto offset = static_cast<char*>(at) - static_cast<char*>(info.dli_fbase);
    text += fmt::format("\n  {} {:#x}", file.substr(file.rfind('/') + 1), offset);
  }
  return text;
}

} // namespace rend::allocations

#ifndef __SANITIZE_ADDRESS__

using rend::allocations::note;

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) noexcept {
  note(__builtin_return_address(0));
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  note(__builtin_return_address(0));
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) noexcept {
  note(__builtin_return_address(0));
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  note(__builtin_return_address(0));
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) noexcept {
  note(__builtin_return_address(0));
  *out = __libc_memalign(alignment, size);
  return *out ? 0 : ENOMEM;
}
} // extern "C"

void* operator new(std::size_t size) {
  note(__builtin_return_address(0));
  if (void* place = __libc_malloc(size ? size : 1)) return place;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  note(__builtin_return_address(0));
  if (void* place = __libc_memalign(static_cast<std::size_t>(alignment), size ? size : 1)) return place;
  throw std::bad_alloc();
}
void operator delete(void* place) noexcept {
  std::free(place);
}
void operator delete(void* place, std::size_t) noexcept {
  std::free(place);
}
void operator delete(void* place, std::align_val_t) noexcept {
  std::free(place);
}
void operator delete(void* place, std::size_t, std::align_val_t) noexcept {
  std::free(place);
}

#endif
