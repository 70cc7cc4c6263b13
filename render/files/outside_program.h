// Runs another program, which is not part of rend: found in PATH, started without a shell, so that no file name
// is taken for a command, and ended after a time limit.
//
// It has a process group of its own, which is killed as a whole, with whatever it has started. If rend is
// killed itself, the system kills the program (prctl(2), PR_SET_PDEATHSIG). It reads nothing (stdin is
// /dev/null); of what it writes to stdout and stderr the end is kept.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rend {

struct ProgramOutcome {
  int code = 0;     // exit code; 128 plus the signal's number where a signal ended it
  std::string said; // stdout and stderr together, the last 64 KiB of them
  enum class End { Itself, TimeLimit, Asked } end = End::Itself;
};

// words[0] is the program, the others are its arguments; it runs in `folder`. It is killed after `most` [s], or
// as soon as `stop()` is true. nullopt: there is no such program. UserError: OutOfBudget where the system
// refuses to start another process, ReadWrite where it cannot be run. Call it from the main thread: to the
// system, the program's parent is the thread that started it.
std::optional<ProgramOutcome> run_outside_program(const std::vector<std::string>& words,
                                                  const std::filesystem::path& folder, double most,
                                                  const std::function<bool()>& stop);

} // namespace rend
