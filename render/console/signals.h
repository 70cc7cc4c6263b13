// Signal handling: on Ctrl-C and the like a run stops after the current step, and what is done so far is kept.
#pragma once

#include "sim/base/error.h"

#include <csignal>

namespace rend {

// SIGHUP, SIGINT, SIGTERM and SIGXCPU request a stop (sim/base/stop_request.h); a second one ends the program
// at once, even in a blocking call, and removes temporary files. SIGHUP and SIGINT stay ignored if they were
// (under nohup; in a shell's background job). SIGPIPE and SIGXFSZ are ignored: writing to a closed pipe, or
// beyond the limit of a file's size, then fails as writing to a full disk does.
void catch_signals();

int stop_signal();                     // the first stop signal received, or 0
Exit exit_code_of_signal();            // the exit code after a stop: 128 plus the signal's number
bool is_exit_code_of_signal(int code); // whether an exit code is one of these

// Blocks signals between fork() and exec(). In the child, a signal in that time would run the parent's handler
// and be lost by exec(). Construct it before fork(); the child calls unblock_in_child().
class BlockedSignals {
public:
  BlockedSignals();
  ~BlockedSignals(); // unblocks signals in the parent
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;
  // restores default handlers and unblocks: a pending signal then ends the process, as it would after exec()
  void unblock_in_child() const;

private:
  sigset_t before_{};
};

// While an object of this class exists, a signal only sets stop_signal() and requests a stop. Otherwise there
// is nothing to save (a preset is read or a scene is built, which may take very long), and a signal ends the
// program at once with 128 plus its number as exit code.
class GracefulStop {
public:
  GracefulStop();
  ~GracefulStop();
  GracefulStop(const GracefulStop&) = delete;
  GracefulStop& operator=(const GracefulStop&) = delete;
};

} // namespace rend
