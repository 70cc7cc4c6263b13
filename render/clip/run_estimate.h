// How long a run is going to take, from its first steps: so that one of hours says so while whoever started it
// still looks.
//
// The first step is left out, for it fills arrays and caches, unless it takes long by itself. Steps are counted
// for a second. What comes later, such as contact and tears, may make steps dearer: it is an estimate.
#pragma once

#include <optional>
#include <string>

namespace rend {

class RunEstimate {
public:
  explicit RunEstimate(long steps) : left_(steps) {} // that are to be made

  bool is_open() const { return open_; } // steps are still counted
  // After a step, with the time that it took [s]: what all others are going to take [s]. Once, and only if that
  // is at least an hour.
  std::optional<double> add(double seconds);

private:
  long left_, made_ = 0, counted_ = 0; // steps
  double sum_ = 0;                     // [s], of those that are counted
  bool open_ = true;
};

std::string hours_in_words(double seconds); // "3.2 hours", "1138 hours (47 days)"

} // namespace rend
