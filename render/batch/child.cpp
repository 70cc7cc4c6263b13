#include "render/batch/child.h"

#include "render/console/signals.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace rend {
namespace {

int file_in_memory(const char* name) {
  const int file = ::memfd_create(name, MFD_CLOEXEC);
  if (file < 0)
    throw UserError(Exit::CannotCreate, {},
                    fmt::format("no room for what a job says: {}", std::strerror(errno)));
  return file;
}

std::string content_of(int file) {
  std::string text;
  char block[4096];
  ::lseek(file, 0, SEEK_SET);
  for (ssize_t count; (count = ::read(file, block, sizeof block)) > 0;)
    text.append(block, static_cast<std::size_t>(count));
  return text;
}

constexpr const char* itself = "/proc/self/exe";

// In the child process, up to exec(): by the path that other processes see, or through /proc/self/exe if that
// file has been moved or removed. Where both fail, exit code 127 as in a shell.
[[noreturn]] void exec_program(const char* program, const std::vector<char*>& words, int parent, int out,
                               int err, const BlockedSignals& held) {
  ::setpgid(0, 0);
  held.unblock_in_child();
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(127); // the parent has ended already
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  ::execv(program, words.data());
  ::execv(itself, words.data());
  ::_exit(127);
}

} // namespace

Child::Child(const std::vector<std::string>& arguments,
             const std::vector<std::pair<std::string, std::string>>& variables)
    : out_(file_in_memory("out")), err_(file_in_memory("err")) {
  std::vector<std::string> kept{"rend"};
  kept.insert(kept.end(), arguments.begin(), arguments.end());
  std::vector<char*> words;
  for (std::string& word : kept) words.push_back(word.data());
  words.push_back(nullptr);
  for (const auto& [name, value] : variables) ::setenv(name.c_str(), value.c_str(), 1);
  std::error_code error;
  const std::string program = std::filesystem::read_symlink(itself, error).string();
  const int parent = ::getpid();
  const BlockedSignals held;
  process_ = ::fork();
  if (process_ == 0) exec_program(program.c_str(), words, parent, out_, err_, held);
  if (process_ < 0)
    throw UserError(
        Exit::OutOfBudget, {}, fmt::format("a job could not be started: {}", std::strerror(errno)),
        "run fewer programs at once, or allow more (ulimit -u, pids.max of a control group) and memory");
}

Child::Child(Child&& other) noexcept
    : process_(std::exchange(other.process_, -1)), out_(std::exchange(other.out_, -1)),
      err_(std::exchange(other.err_, -1)), code_(other.code_), peak_(other.peak_) {}

Child::~Child() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  if (out_ >= 0) ::close(out_);
  if (err_ >= 0) ::close(err_);
}

bool Child::running() {
  if (process_ < 0) return false;
  int status = 0;
  rusage usage{};
  if (::wait4(process_, &status, WNOHANG, &usage) != process_) return true;
  process_ = -1;
  code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  peak_ = static_cast<std::size_t>(usage.ru_maxrss) * 1024;
  return false;
}

void Child::signal(int number) const {
  if (process_ > 0) ::kill(process_, number);
}

std::size_t Child::resident() const {
  if (process_ < 0) return 0;
  std::ifstream file(fmt::format("/proc/{}/statm", process_));
  std::size_t all = 0, resident = 0;
  file >> all >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

std::string Child::out() const {
  return content_of(out_);
}
std::string Child::err() const {
  return content_of(err_);
}

} // namespace rend
