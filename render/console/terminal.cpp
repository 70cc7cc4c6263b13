#include "render/console/terminal.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <sys/ioctl.h>
#include <unistd.h>

namespace rend {

std::optional<std::size_t> terminal_columns(std::FILE* stream) {
  winsize size{};
  if (::isatty(::fileno(stream)) == 0 || ::ioctl(::fileno(stream), TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
    return {};
  return size.ws_col;
}

std::size_t text_columns(std::FILE* stream, std::size_t most) {
  constexpr std::size_t least = 20;
  std::size_t columns = 0;
  if (const char* asked = std::getenv("COLUMNS"))
    std::from_chars(asked, asked + std::strlen(asked), columns); // what is no number leaves 0
  if (columns == 0) columns = terminal_columns(stream).value_or(most);
  return std::clamp(columns, least, most);
}

} // namespace rend
