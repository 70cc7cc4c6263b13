// The run time of the rows of each interaction, if it is measured (ProgramOptions::timed).
//
// Rows of all interactions are run tile by tile, by several threads: each thread accumulates its own times
// (Laps) and adds them once, when its part is done. If nothing is measured there is no RowTimes, and a lap only
// tests a pointer.
#pragma once

#include "sim/base/profile.h"

#include <mutex>
#include <vector>

namespace rend {

class RowTimes {
public:
  explicit RowTimes(std::size_t interactions) : seconds_(interactions), reading_(clock_reading()) {}
  void count() { ++evaluations_; }
  void resize(std::size_t interactions) { seconds_.resize(interactions); }

  long evaluations() const { return evaluations_; }
  double seconds(std::size_t interaction) const { return seconds_[interaction]; } // summed over all threads

  // For one part of one evaluation.
  class Laps {
  public:
    explicit Laps(RowTimes* times);
    ~Laps();
    Laps(const Laps&) = delete;
    Laps& operator=(const Laps&) = delete;
    void begin() { // discards the time since the last lap
      if (times_) since_ = Clock::now();
    }
    void end(std::size_t interaction) { // adds the time since begin() or the last lap
      if (times_) add(interaction);
    }

  private:
    using Clock = std::chrono::steady_clock;
    void add(std::size_t interaction);
    RowTimes* times_;             // null: not measured
    std::vector<double> seconds_; // one per interaction
    Clock::time_point since_;
  };

private:
  void take(const std::vector<double>& seconds);

  std::mutex mutex_;
  std::vector<double> seconds_; // one per interaction
  long evaluations_ = 0;
  double reading_; // [s] that reading the clock takes
};

} // namespace rend
