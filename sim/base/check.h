// CHECK: an assertion against programming errors, not user errors. The message names the condition and its
// place; main catches it (exit code 70).
#pragma once

#include <stdexcept>
#include <string>

namespace rend {

// Thrown by CHECK: a bug in rend.
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
