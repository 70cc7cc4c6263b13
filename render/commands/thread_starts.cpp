// How threads of this program are started, those of libraries too: what the system refuses is tried again for a
// moment, as others may end meanwhile; what it refuses for good is counted (sim/base/worker_threads.h).
//
// Few libraries say what they could not start, and llvmpipe (Mesa 22.3) goes on and waits for it.
//
// Compiled into the program, not into the library: that leaves pthread_create to those who link it.
#include "sim/base/worker_threads.h"

#include <cerrno>
#include <ctime>
#include <dlfcn.h>
#include <pthread.h>

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*),
                              void* argument) noexcept {
  using Start = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "pthread_create"));
  constexpr int tries = 10; // together 45 ms
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
