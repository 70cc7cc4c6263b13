// What came of one job of a batch.
#pragma once

#include "render/batch/child.h"
#include "render/clip/printed_figures.h"

#include <optional>
#include <string>

namespace rend {

enum class BatchState { Done, Unstable, Failed, Stopped };
const char* name_of(BatchState state); // "done"

struct BatchResult {
  bool ran = false;     // to its end, whatever that was; not: it was stopped with the batch, or not begun
  int tries = 0;        // how often it was begun: more than once where it had to make room
  int code = 0;         // exit code
  double seconds = 0;   // on the clock, of all its tries
  std::size_t peak = 0; // [bytes]
  std::optional<PrintedFigures> figures; // none: it did not come to printing them
  std::string printed;                   // what it wrote to stdout: its figures
  std::string log;                       // what it wrote to stderr
  std::string message;                   // the first line of what it said went wrong; empty: nothing

  BatchState state() const;
  bool done() const { return state() == BatchState::Done; }
  bool failed() const; // it ran, and not to a good end
};

// Of a job's program that runs no more: its exit code, its figures and its message. Without `ran` it was
// stopped with the batch.
void take_end(BatchResult& result, const Child& child, bool ran);

} // namespace rend
