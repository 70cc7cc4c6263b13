// Ctrl-C and the like: a run stops after the step it is in, and what is done so far is kept.
#pragma once

#include "sim/base/error.h"

#include <csignal>

namespace rend {

// SIGHUP, SIGINT, SIGTERM and SIGXCPU ask for a stop, and a second one ends the program at once, whatever it is
// waiting for. SIGHUP and SIGINT stay ignored where they were (under nohup; in a shell's background job).
// SIGPIPE and SIGXFSZ are ignored: writing to a closed pipe, or more than a file may hold, then fails as
// writing to a full disk does.
void catch_signals();

int stop_signal();             // the one that came first, or 0
Exit exit_of_a_signal();       // of this program, which it has stopped: 128 and its number
bool is_of_a_signal(int code); // whether an exit code is such a one

// Between fork() and exec() a signal would find the handler of the parent, and be forgotten by exec(). Until
// then it is held back: made before fork(); released in the new process by let_in().
class SignalsHeld {
public:
  SignalsHeld();
  ~SignalsHeld(); // in the parent
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;
  void let_in() const; // what came ends the process, as it would after exec()

private:
  sigset_t before_{};
};

// While one is there a signal waits to be asked for by stop_signal(). Else nothing is to be kept (a preset is
// read, a scene is built, either of which may take for ever): then it ends the program at once, with 128 and
// its number as exit code.
class Keeping {
public:
  Keeping();
  ~Keeping();
  Keeping(const Keeping&) = delete;
  Keeping& operator=(const Keeping&) = delete;
};

} // namespace rend
