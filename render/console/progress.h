// Progress of a run on stderr: a bar on a terminal, a line every ten seconds elsewhere, nothing if quiet.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

namespace rend {

// What a bar tells, the most important first; what does not fit is left out.
struct ProgressParts {
  double share = 0;                // of the steps, 0 to 1
  std::vector<std::string> pieces; // "12 s left", "0.10 of 4.00 s", ...
};

// A bar with its pieces in at most `columns`, which are at least 4; `colour` adds codes, which take no columns.
std::string bar_line(const ProgressParts& parts, std::size_t columns, bool colour);

class Progress {
public:
  // `steps` in all, `duration` [s] simulated, `frames` in all; frames = 0: none are made.
  Progress(bool quiet, long steps, double duration, long frames);
  ~Progress(); // clears the bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Cheap enough to be called in every step: reads a coarse clock, and prints rarely.
  void update(long step, double time, long frame);
  void clear(); // removes the bar before other text is printed

private:
  struct Sample {
    double at = 0; // wall clock [s]
    long step = 0, frame = 0;
  };
  ProgressParts parts(const Sample& now, double time) const;

  bool quiet_, terminal_, colour_;
  long steps_, frames_;
  double duration_;
  double next_ = 0;           // [s], when to print next
  bool shown_ = false;        // a bar is on the screen
  std::deque<Sample> recent_; // the last seconds, for the current speed instead of the average
};

} // namespace rend
