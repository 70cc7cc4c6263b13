// CHECK: a programmer's slip, not a user's. It names the condition and its place and is caught in main (exit
// 70).
#pragma once

#include <stdexcept>
#include <string>

namespace rend {

// Thrown by CHECK: rend itself is wrong.
struct InternalError : std::logic_error {
  using std::logic_error::logic_error;
};

[[noreturn]] void check_failed(const char* condition, const char* file, int line, const std::string& note = {});

} // namespace rend

#define CHECK(condition)                                                                                       \
  do {                                                                                                         \
    if (!(condition)) ::rend::check_failed(#condition, __FILE__, __LINE__);                                    \
  } while (false)

#define CHECK_NOTE(condition, note)                                                                            \
  do {                                                                                                         \
    if (!(condition)) ::rend::check_failed(#condition, __FILE__, __LINE__, (note));                            \
  } while (false)
