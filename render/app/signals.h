// Ctrl-C and the like: the run stops after the step it is in, and what is done so far is kept.
#pragma once

namespace rend {

// SIGINT and SIGTERM ask for a stop (a second one ends the program at once). SIGPIPE and SIGXFSZ are ignored:
// writing to a closed pipe, or more than a file may hold, then fails as writing to a full disk does.
void catch_signals();

int stop_signal(); // the one that came, or 0

// While one is there nothing is to be kept (a scene is being built, which may take long): a signal ends the
// program at once, with 128 and its number as exit code.
class NothingToKeep {
public:
  NothingToKeep();
  ~NothingToKeep();
  NothingToKeep(const NothingToKeep&) = delete;
  NothingToKeep& operator=(const NothingToKeep&) = delete;
};

} // namespace rend
