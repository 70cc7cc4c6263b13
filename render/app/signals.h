// Ctrl-C and the like: the run stops after the step it is in, and what is done so far is kept.
#pragma once

namespace rend {

// SIGINT and SIGTERM ask for a stop (a second one ends the program at once). SIGPIPE is ignored: writing to a
// closed pipe then fails as writing to a full disk does.
void catch_signals();

int stop_signal(); // the one that came, or 0

} // namespace rend
