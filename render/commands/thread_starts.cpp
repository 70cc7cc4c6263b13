// Wraps pthread_create for this program, including its libraries: a refused start is retried for a moment,
// since other threads may end meanwhile; final refusals are counted (sim/base/worker_threads.h).
//
// Few libraries report a thread that they could not start, and llvmpipe (Mesa 22.3) goes on to wait for it.
//
// Compiled into the program, not into the library: replacing pthread_create is left to the program that links
// it.
#include "sim/base/worker_threads.h"

#include <cerrno>
#include <ctime>
#include <dlfcn.h>
#include <pthread.h>

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*),
                              void* argument) noexcept {
  using Start = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "pthread_create"));
  constexpr int tries = 10; // 45 ms in total
  int error = EAGAIN;
  for (int n = 0; n < tries && error == EAGAIN; ++n) {
    if (n > 0) {
      const timespec moment{0, n * 1'000'000L};
      nanosleep(&moment, nullptr);
    }
    error = start(thread, attributes, work, argument);
  }
  if (error != 0) rend::count_refused_thread_start();
  return error;
}
