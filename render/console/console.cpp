#include "render/console/console.h"

#include "render/console/signals.h"
#include "sim/base/printable.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace rend {

void keep_standard_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) // open() takes the lowest that is free
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

bool is_terminal(std::FILE* stream) {
  return ::isatty(::fileno(stream)) != 0;
}

bool wants_colour(std::FILE* stream) {
  const char* no = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  return is_terminal(stream) && !(no && *no) && terminal && std::strcmp(terminal, "dumb") != 0;
}

void print_result(std::string_view text) {
  print_trusted_result(printable_lines(text));
}

void print_trusted_result(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  if (stop_signal() == SIGHUP) return; // the terminal has closed: nobody reads any more
  if (errno == EPIPE) throw BrokenPipe();
  throw UserError(Exit::ReadWrite, {},
                  fmt::format("writing to standard output failed: {}", std::strerror(errno)));
}

namespace {

void print(const char* colour, std::string_view label, const std::string& what, const std::string& hint) {
  const bool on = wants_colour(stderr);
  const char* plain = on ? "\033[0m" : "";
  std::string text = fmt::format("{}{}{} {}\n", on ? colour : "", label, plain, printable(what));
  if (!hint.empty()) text += fmt::format("  {}hint:{} {}\n", on ? "\033[36m" : "", plain, printable(hint));
  print_progress(text);
}

} // namespace

void print_error(const std::string& what, const std::string& hint) {
  print("\033[1;31m", "rend: error:", what, hint);
}

void print_note(const std::string& what) {
  print("\033[36m", "note:", what, {});
}

void print_progress(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void note_fewer_threads() {
  print_note("the system could not start all threads; with fewer, this takes longer");
}

std::string seconds_in_words(double seconds) {
  if (seconds < 100) return fmt::format("{:.3g} s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string bytes_in_words(std::size_t bytes) {
  const auto b = static_cast<double>(bytes);
  if (bytes < 1000) return fmt::format("{} B", bytes);
  if (b < 1e6) return fmt::format("{:.1f} kB", b / 1e3);
  if (b < 1e9) return fmt::format("{:.1f} MB", b / 1e6);
  return fmt::format("{:.2f} GB", b / 1e9);
}

} // namespace rend
