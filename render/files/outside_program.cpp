#include "render/files/outside_program.h"

#include "sim/base/error.h"
#include "sim/base/wall_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <string_view>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

extern char** environ;

namespace rend {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& program, int error) {
  if (error == EAGAIN || error == ENOMEM || error == EMFILE || error == ENFILE)
    throw UserError(
        Exit::OutOfBudget, {}, fmt::format("{} could not be started: {}", program, std::strerror(error)),
        "run fewer programs at once, or allow more (ulimit -u, pids.max of a control group) and memory");
  throw UserError(Exit::ReadWrite, {}, fmt::format("{} could not be run: {}", program, std::strerror(error)));
}

// The file that a shell would start, by its absolute path; empty: none.
fs::path found_in_path(const std::string& program) {
  const char* variable = std::getenv("PATH");
  std::string_view folders = variable ? variable : "/usr/bin:/bin";
  while (true) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    std::error_code error;
    const fs::path file = fs::absolute(fs::path(folders.substr(0, end)) / program, error);
    if (!error && fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0) return file;
    if (end == folders.size()) return {};
    folders.remove_prefix(end + 1);
  }
}

class Descriptor {
public:
  explicit Descriptor(int file = -1) : file_(file) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;

  int number() const { return file_; }
  void close() {
    if (file_ >= 0) ::close(file_);
    file_ = -1;
  }

private:
  int file_;
};

struct Pipe {
  Descriptor out, in; // to be read, to be written
};

Pipe make_pipe(const std::string& program) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) fail(program, errno);
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

// What a new process needs: made before fork(), after which it may not allocate memory (another thread may have
// held the lock of the heap).
struct Start {
  const char* file;
  char* const* arguments;
  const char* folder;
  int said, failed; // descriptors: for what it says, for the number of an error
  pid_t parent;
};

// The new process: its own group, usual signals, streams and folder. Only calls that are safe in a signal
// handler.
[[noreturn]] void become(const Start& start) {
  const auto give_up = [&] {
    const int error = errno;
    [[maybe_unused]] const ssize_t told = ::write(start.failed, &error, sizeof error);
    ::_exit(127);
  };
  ::setpgid(0, 0);
  if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) give_up();
  if (::getppid() != start.parent) ::_exit(127); // rend has been killed before
  struct sigaction usual {};
  usual.sa_handler = SIG_DFL;
  for (const int number : {SIGHUP, SIGINT, SIGTERM, SIGPIPE, SIGXFSZ, SIGXCPU})
    ::sigaction(number, &usual, nullptr);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nothing = ::open("/dev/null", O_RDONLY);
  if (nothing < 0 || ::dup2(nothing, STDIN_FILENO) < 0 || ::dup2(start.said, STDOUT_FILENO) < 0 ||
      ::dup2(start.said, STDERR_FILENO) < 0 || ::chdir(start.folder) != 0)
    give_up();
  ::execve(start.file, start.arguments, environ);
  give_up();
  ::_exit(127);
}

// The new process; it has signals blocked until its handlers are gone.
pid_t fork_to(const Start& start, const std::string& program) {
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before);
  const pid_t child = ::fork();
  if (child == 0) become(start);
  const int error = errno;
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (child < 0) fail(program, error);
  return child;
}

// The end of what a program says. It is read on and on: a full pipe would make the program wait.
class Said {
public:
  explicit Said(Descriptor out) : out_(std::move(out)) { ::fcntl(out_.number(), F_SETFL, O_NONBLOCK); }

  // What has come by now, as far as it comes within a moment, or a pause if nothing has.
  void listen(int milliseconds) {
    pollfd ready{out_.number(), POLLIN, 0};
    if (!open_ || ::poll(&ready, 1, milliseconds) <= 0) {
      if (!open_) ::usleep(static_cast<useconds_t>(milliseconds) * 1000);
      return;
    }
    take_what_is_there();
  }
  // A pipe holds less than that; whoever goes on writing is not waited for.
  void take_what_is_there() {
    constexpr int most_blocks = 64;
    std::array<char, 65536> block;
    for (int n = 0; n < most_blocks && open_; ++n) {
      const ssize_t count = ::read(out_.number(), block.data(), block.size());
      if (count < 0) return;
      open_ = count > 0;
      kept_.append(block.data(), static_cast<std::size_t>(count));
      if (kept_.size() > 2 * most) kept_.erase(0, kept_.size() - most);
    }
  }
  std::string text() const { return kept_.substr(kept_.size() - std::min(kept_.size(), most)); }

private:
  static constexpr std::size_t most = 65536; // [bytes]
  Descriptor out_;
  bool open_ = true;
  std::string kept_;
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

// 0 once the program runs; else the number of the error for which it does not.
int error_of_start(const Pipe& failed) {
  int error = 0;
  ssize_t count;
  do count = ::read(failed.out.number(), &error, sizeof error);
  while (count < 0 && errno == EINTR);
  return count == sizeof error ? error : 0;
}

} // namespace

std::optional<ProgramOutcome> run_outside_program(const std::vector<std::string>& words,
                                                  const std::filesystem::path& folder, double most,
                                                  const std::function<bool()>& stop) {
  const double start = wall_clock();
  const fs::path file = found_in_path(words.front());
  if (file.empty()) return {};
  std::vector<std::string> kept = words;
  std::vector<char*> arguments;
  for (std::string& word : kept) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  Pipe saying = make_pipe(words.front()), failed = make_pipe(words.front());
  const pid_t child = fork_to(
      {file.c_str(), arguments.data(), folder.c_str(), saying.in.number(), failed.in.number(), ::getpid()},
      words.front());
  ProgramOutcome outcome;
  Said said(std::move(saying.out));
  {
    Group group(child);
    saying.in.close();
    failed.in.close();
    if (const int error = error_of_start(failed); error == ENOENT)
      return {};
    else if (error != 0)
      fail(words.front(), error);
    while (true) {
      if (const auto code = group.ended()) {
        outcome.code = *code;
        break;
      }
      if (stop()) outcome.end = ProgramOutcome::End::Asked;
      if (wall_clock() - start > most) outcome.end = ProgramOutcome::End::TimeLimit;
      if (outcome.end != ProgramOutcome::End::Itself) break;
      said.listen(5);
    }
  }
  said.take_what_is_there();
  outcome.said = said.text();
  return outcome;
}

} // namespace rend
