#include "sim/base/check.h"

#include <fmt/format.h>

namespace rend {

void check_failed(const char* condition, const char* file, int line, const std::string& note) {
  throw InternalError(
      fmt::format("{}:{}: this should hold: {}{}{}", file, line, condition, note.empty() ? "" : ": ", note));
}

} // namespace rend
