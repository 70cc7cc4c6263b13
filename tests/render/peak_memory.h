// Measures peak memory.
#pragma once

#include <algorithm>
#include <cstdint>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rend::test {

// Runs the action in a child process, since the peak of this one includes earlier tests. Returns [bytes] by
// which that process grew, or the peak of the largest program that it ran; -1 if the action threw.
template <class Action> std::int64_t peak_of(const Action& action) {
  const auto of = [](int who) {
    rusage usage{};
    getrusage(who, &usage);
    return std::int64_t{usage.ru_maxrss} * 1024;
  };
  malloc_trim(0); // else it might reuse memory freed by earlier tests, and not grow
  int ends[2];
  if (pipe(ends) != 0) return -1;
  const pid_t child = fork();
  if (child == 0) {
    const std::int64_t before = of(RUSAGE_SELF);
    try {
      action();
    } catch (...) {
      _exit(1);
    }
    const std::int64_t grown = std::max(of(RUSAGE_SELF) - before, of(RUSAGE_CHILDREN));
    _exit(write(ends[1], &grown, sizeof grown) == sizeof grown ? 0 : 1);
  }
  close(ends[1]);
  std::int64_t grown = -1;
  if (read(ends[0], &grown, sizeof grown) != sizeof grown) grown = -1;
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return grown;
}

constexpr std::int64_t megabyte = 1'000'000;

} // namespace rend::test
