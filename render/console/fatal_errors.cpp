#include "render/console/fatal_errors.h"

#include "render/console/console.h"
#include "render/files/memory_left.h"
#include "render/files/temporaries.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>
#include <unistd.h>

namespace rend {
namespace {

bool coloured = false;

struct FatalMessage {
  const char *what, *hint;
};
constexpr FatalMessage no_memory{
    "there is not enough memory for this",
    "use fewer cells, smaller pictures or fewer samples, or allow more memory (ulimit -v)"};
constexpr FatalMessage no_thread{
    "a thread could not be started",
    "run fewer programs at once, or allow more threads (ulimit -u, pids.max of a control group) and memory"};
constexpr FatalMessage fault{"this is a fault of rend itself: ",
                             "please report it, with the command line and the preset"};

void say(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(STDERR_FILENO, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

// As print_error(), without allocating memory.
void say(const FatalMessage& words, std::string_view more) {
  say(coloured ? "\033[1;31mrend: error:\033[0m " : "rend: error: ");
  say(words.what);
  say(more);
  if (*words.hint != '\0') {
    say(coloured ? "\n  \033[36mhint:\033[0m " : "\n  hint: ");
    say(words.hint);
  }
  say("\n");
}

// The first thread that gets here ends the program; others wait for that.
[[noreturn]] void end(Exit code, const FatalMessage& words, std::string_view more = {}) noexcept {
  static std::atomic<pid_t> first = 0;
  pid_t none = 0;
  const pid_t self = ::gettid();
  if (!first.compare_exchange_strong(none, self)) {
    while (none != self) ::pause();
    ::_exit(static_cast<int>(code)); // a crash in the code below, in the same thread
  }
  say(words, more);
  remove_temporaries();
  ::_exit(static_cast<int>(code));
}

constexpr std::array crashes{SIGSEGV, SIGBUS, SIGABRT, SIGILL};
std::array<struct sigaction, crashes.size()> actions_before;

// If memory is not the reason, restores the previous handler: a faulting instruction is executed again on
// return, a signal that was sent is raised again.
void on_crash(int signal, siginfo_t* info, void*) {
  if (!is_memory_left()) end(Exit::OutOfBudget, no_memory);
  for (std::size_t n = 0; n < crashes.size(); ++n)
    if (crashes[n] == signal) ::sigaction(signal, &actions_before[n], nullptr);
  if (info->si_code <= 0) ::raise(signal);
}

[[noreturn]] void on_terminate() noexcept {
  try {
    if (const std::exception_ptr exception = std::current_exception()) std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
    end(Exit::OutOfBudget, no_memory);
  } catch (const UserError& error_of_user) {
    end(error_of_user.code, {"", error_of_user.hint.c_str()}, error_of_user.what());
  } catch (const std::exception& thrown) {
    // Thrown when a thread of oneTBB fails to start another one (sim/base/threads.cpp).
    const auto* of_system = dynamic_cast<const std::system_error*>(&thrown);
    const bool of_thread = std::strstr(thrown.what(), "pthread_create") != nullptr ||
                           (of_system != nullptr && of_system->code().value() == EAGAIN);
    if (of_thread) end(Exit::OutOfBudget, no_thread);
    end(Exit::Bug, fault, thrown.what());
  } catch (...) {
  }
  if (!is_memory_left()) end(Exit::OutOfBudget, no_memory);
  end(Exit::Bug, fault, "something was left unfinished");
}

} // namespace

void install_fatal_error_handlers() {
  coloured = wants_colour(stderr);
  std::set_new_handler(end_without_memory);
  std::set_terminate(on_terminate);
  struct sigaction action {};
  action.sa_sigaction = on_crash;
  action.sa_flags = SA_SIGINFO;
  sigemptyset(&action.sa_mask);
  for (std::size_t n = 0; n < crashes.size(); ++n) ::sigaction(crashes[n], &action, &actions_before[n]);
}

void end_without_memory() noexcept {
  end(Exit::OutOfBudget, no_memory);
}

} // namespace rend
