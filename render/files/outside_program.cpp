#include "render/files/outside_program.h"

#include "sim/base/error.h"
#include "sim/base/wall_clock.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace rend {
namespace {

[[noreturn]] void fail(const std::string& program, int error) {
  throw UserError(Exit::ReadWrite, {}, fmt::format("{} could not be run: {}", program, std::strerror(error)));
}

// What it says: an unnamed in-memory file, which unlike a pipe never blocks.
class Said {
public:
  explicit Said(const std::string& program) : file_(::memfd_create("said", MFD_CLOEXEC)) {
    if (file_ < 0) fail(program, errno);
  }
  ~Said() { ::close(file_); }
  Said(const Said&) = delete;
  Said& operator=(const Said&) = delete;

  int file() const { return file_; }
  std::string text() const {
    std::string out;
    std::array<char, 65536> block{};
    ::lseek(file_, 0, SEEK_SET);
    for (ssize_t count; (count = ::read(file_, block.data(), block.size())) > 0;)
      out.append(block.data(), static_cast<std::size_t>(count));
    return out;
  }

private:
  int file_;
};

// How the process starts: its streams, folder, group and signals.
class Start {
public:
  Start(const std::filesystem::path& folder, int said) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, said, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, said, STDERR_FILENO);
    posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    posix_spawnattr_init(&attributes_);
    sigset_t none, usual;
    sigemptyset(&none);
    sigemptyset(&usual);
    for (const int number : {SIGHUP, SIGINT, SIGTERM, SIGPIPE, SIGXFSZ, SIGXCPU}) sigaddset(&usual, number);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &usual);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_,
                             POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~Start() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  Start(const Start&) = delete;
  Start& operator=(const Start&) = delete;

  // 0, or an error number.
  int run(const std::vector<std::string>& words, pid_t& child) const {
    std::vector<std::string> kept = words;
    std::vector<char*> arguments;
    for (std::string& word : kept) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    return ::posix_spawnp(&child, arguments.front(), &actions_, &attributes_, arguments.data(), environ);
  }

private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

// Kills and reaps the group of a process, however it is left.
class Group {
public:
  explicit Group(pid_t first) : first_(first) {}
  ~Group() {
    ::kill(-first_, SIGKILL);
    if (!reaped_) ::waitpid(first_, nullptr, 0);
  }
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;

  // The exit code, once the first process has ended.
  std::optional<int> ended() {
    int status = 0;
    if (::waitpid(first_, &status, WNOHANG) != first_) return {};
    reaped_ = true;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

private:
  pid_t first_;
  bool reaped_ = false;
};

} // namespace

std::optional<ProgramOutcome> run_outside_program(const std::vector<std::string>& words,
                                                  const std::filesystem::path& folder, double most,
                                                  const std::function<bool()>& stop) {
  constexpr useconds_t pause = 5000; // [µs] between looks
  const Said said(words.front());
  pid_t child = 0;
  const int error = Start(folder, said.file()).run(words, child);
  if (error == ENOENT) return {};
  if (error == EAGAIN || error == ENOMEM)
    throw UserError(
        Exit::OutOfBudget, {}, fmt::format("{} could not be started: {}", words.front(), std::strerror(error)),
        "run fewer programs at once, or allow more (ulimit -u, pids.max of a control group) and memory");
  if (error != 0) fail(words.front(), error);
  ProgramOutcome outcome;
  const double start = wall_clock();
  {
    Group group(child);
    while (true) {
      if (const auto code = group.ended()) {
        outcome.code = *code;
        break;
      }
      if (stop()) outcome.end = ProgramOutcome::End::Asked;
      if (wall_clock() - start > most) outcome.end = ProgramOutcome::End::TimeLimit;
      if (outcome.end != ProgramOutcome::End::Itself) break;
      ::usleep(pause);
    }
  }
  outcome.said = said.text();
  return outcome;
}

} // namespace rend
