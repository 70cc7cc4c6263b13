#include "render/report/gnuplot.h"

#include "sim/base/error.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace rend {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw UserError(Exit::ReadWrite, {}, "gnuplot could not draw a plot: " + what,
                  "Check that 'gnuplot' in your PATH runs; Debian has it as gnuplot-nox.");
}

// An unnamed in-memory file: unlike a pipe it never blocks.
class Scratch {
public:
  explicit Scratch(const char* name) : file_(::memfd_create(name, MFD_CLOEXEC)) {
    if (file_ < 0) fail(std::strerror(errno));
  }
  ~Scratch() { ::close(file_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  int file() const { return file_; }
  void write(const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
      const ssize_t count = ::write(file_, text.data() + at, text.size() - at);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) fail(std::strerror(errno));
      at += static_cast<std::size_t>(count);
    }
    ::lseek(file_, 0, SEEK_SET);
  }
  std::string content() const {
    ::lseek(file_, 0, SEEK_SET);
    std::string out;
    std::array<char, 65536> block{};
    while (true) {
      const ssize_t count = ::read(file_, block.data(), block.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail(std::strerror(errno));
      if (count == 0) return out;
      out.append(block.data(), static_cast<std::size_t>(count));
    }
  }

private:
  int file_;
};

// Starts the process; 0: it is not installed.
pid_t start(const Scratch& in, const Scratch& out, const Scratch& err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in.file(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out.file(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.file(), STDERR_FILENO);
  std::string program = "gnuplot", defaults = "--default-settings"; // ignores the user's ~/.gnuplot
  std::array<char*, 3> arguments{program.data(), defaults.data(), nullptr};
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) return 0;
  if (error == EAGAIN || error == ENOMEM)
    throw UserError(
        Exit::OutOfBudget, {}, std::string("gnuplot could not be started: ") + std::strerror(error),
        "run fewer programs at once, or allow more (ulimit -u, pids.max of a control group) and memory");
  if (error != 0) fail(std::strerror(error));
  return child;
}

} // namespace

std::optional<std::string> run_gnuplot(const std::string& script) {
  Scratch in("script");
  const Scratch out("picture"), err("messages");
  in.write(script);
  const pid_t child = start(in, out, err);
  if (child == 0) return {};
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) fail(std::strerror(errno));
  std::string picture = out.content();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || picture.empty()) fail(err.content());
  return picture;
}

} // namespace rend
