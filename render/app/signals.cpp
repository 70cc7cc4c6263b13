#include "render/app/signals.h"

#include <csignal>
#include <ctime>
#include <unistd.h>

namespace rend {
namespace {

volatile std::sig_atomic_t caught = 0, nothing_to_keep = 0;

// [s], of the first signal; what comes within `same` of it was sent to several at once, and is the same.
double first_at = 0;
constexpr double same = 0.3;

double now() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Signals wait for each other: sa_mask.
void on_signal(int signal) {
  if (nothing_to_keep != 0 || (caught != 0 && now() - first_at > same)) _exit(128 + signal);
  if (caught == 0) first_at = now();
  caught = signal;
}

} // namespace

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESTART);
  sigemptyset(&action.sa_mask);
  sigaddset(&action.sa_mask, SIGINT);
  sigaddset(&action.sa_mask, SIGTERM);
  struct sigaction before {};
  sigaction(SIGINT, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGINT, &action, nullptr); // a shell's background job ignores it
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

NothingToKeep::NothingToKeep() {
  nothing_to_keep = 1;
}
NothingToKeep::~NothingToKeep() {
  nothing_to_keep = 0;
}

int stop_signal() {
  return caught;
}

} // namespace rend
