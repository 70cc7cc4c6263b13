#include "sim/base/error.h"

#include <fmt/format.h>

namespace rend {

std::string Place::text() const {
  if (line <= 0) return file;
  return fmt::format("{}:{}:{}", file, line, column);
}

UserError::UserError(Exit code_, const Place& place, const std::string& what, const std::string& hint_)
    : std::runtime_error(place.file.empty() ? what : place.text() + ": " + what), code(code_), hint(hint_) {}

} // namespace rend
