#include "render/console/signals.h"

#include "render/files/temporaries.h"
#include "sim/base/stop_request.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <ctime>
#include <unistd.h>

namespace rend {
namespace {

constexpr std::array all{SIGHUP, SIGINT, SIGTERM, SIGXCPU};

// Shared with the handler, which can run in two threads at once.
std::atomic<int> caught = 0, graceful_stop = 0;
std::atomic<double> first_at = 0; // [s], of the first signal
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<double>::is_always_lock_free);

// [s]. A signal within this time of the first counts as the same request: it was sent to the whole process
// group, or by several senders.
constexpr double same_request = 0.3;

double now() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Whether the kernel sent it because of a limit of processor time: then it comes every second, from the soft to
// the hard limit.
bool is_repeated(const siginfo_t& how) {
  return how.si_signo == SIGXCPU && how.si_code == SI_KERNEL;
}

// Leaves no temporary file.
[[noreturn]] void end_at_once(int signal) {
  remove_temporaries();
  _exit(128 + signal);
}

void on_signal(int signal, siginfo_t* how, void* /*context*/) {
  if (graceful_stop == 0) end_at_once(signal);
  double none = 0;
  const double at = now();
  if (first_at.compare_exchange_strong(none, at)) {
    caught = signal;
    request_stop();
  } else if (at - first_at > same_request && !is_repeated(*how)) {
    end_at_once(signal);
  }
}

bool is_ignored(int signal) {
  struct sigaction before {};
  sigaction(signal, nullptr, &before);
  return before.sa_handler == SIG_IGN;
}

} // namespace

// SA_RESTART: blocking calls are not interrupted, since their callers do not handle EINTR.
void catch_signals() {
  struct sigaction action {};
  action.sa_sigaction = on_signal;
  action.sa_flags = static_cast<int>(SA_RESTART | SA_SIGINFO);
  sigemptyset(&action.sa_mask);
  for (const int signal : all) sigaddset(&action.sa_mask, signal);
  for (const int signal : all)
    if ((signal != SIGHUP && signal != SIGINT) || !is_ignored(signal)) sigaction(signal, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

BlockedSignals::BlockedSignals() {
  sigset_t held;
  sigemptyset(&held);
  for (const int signal : all) sigaddset(&held, signal);
  pthread_sigmask(SIG_BLOCK, &held, &before_);
}

BlockedSignals::~BlockedSignals() {
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void BlockedSignals::unblock_in_child() const {
  for (const int signal : all)
    if (!is_ignored(signal)) std::signal(signal, SIG_DFL);
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

GracefulStop::GracefulStop() {
  ++graceful_stop;
}
GracefulStop::~GracefulStop() {
  --graceful_stop;
}

int stop_signal() {
  return caught;
}

Exit exit_code_of_signal() {
  return Exit{128 + stop_signal()};
}

bool is_exit_code_of_signal(int code) {
  return std::find(all.begin(), all.end(), code - 128) != all.end();
}

} // namespace rend
