// A library for LD_PRELOAD that simulates a system that refuses to start threads or processes. Limits of users
// (ulimit -u) do not apply to root, as whom tests may run.
//
//   REND_THREAD_THAT_FAILS=3   the third thread is refused
//   REND_MOST_THREADS=3        threads are refused while three run besides the main thread
//   REND_THREADS_MARK=FILE     this file is created when a thread is refused
//   REND_FORK_THAT_FAILS=2     the second fork is refused
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

namespace {

using Start = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);

std::atomic<int> started = 0, living = 0, forks = 0;

int number_in(const char* name) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : 0;
}

struct Thread {
  void* (*work)(void*);
  void* argument;
};

void* run(void* it) {
  const Thread thread = *static_cast<Thread*>(it);
  std::free(it);
  struct Ended {
    ~Ended() { --living; }
  } const ended;
  return thread.work(thread.argument);
}

int refuse() {
  if (const char* mark = std::getenv("REND_THREADS_MARK")) {
    const int file = ::open(mark, O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (file >= 0) ::close(file);
  }
  return EAGAIN;
}

} // namespace

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*),
                              void* argument) noexcept {
  static const auto real = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "pthread_create"));
  if (++started == number_in("REND_THREAD_THAT_FAILS")) return refuse();
  const int most = number_in("REND_MOST_THREADS");
  if (++living > most && std::getenv("REND_MOST_THREADS")) {
    --living;
    return refuse();
  }
  auto* const it = static_cast<Thread*>(std::malloc(sizeof(Thread)));
  *it = {work, argument};
  return real(thread, attributes, run, it);
}

extern "C" pid_t fork() noexcept {
  static const auto real = reinterpret_cast<pid_t (*)()>(dlsym(RTLD_NEXT, "fork"));
  if (++forks != number_in("REND_FORK_THAT_FAILS")) return real();
  errno = EAGAIN;
  return -1;
}
