// Progress of a run on stderr: a bar on a terminal, a line every few seconds elsewhere, nothing if quiet.
#pragma once

#include <deque>
#include <string>

namespace rend {

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
  std::string line(const Sample& now, double time) const;

  bool quiet_, terminal_, colour_;
  long steps_, frames_;
  double duration_;
  double next_ = 0;           // [s], when to print next
  bool shown_ = false;        // a bar is on the screen
  std::deque<Sample> recent_; // the last seconds, for the current speed instead of the average
};

} // namespace rend
