// What the rows of each interaction take, for those who ask (ProgramOptions::timed).
//
// Rows of all interactions are run tile by tile, by several threads: each thread adds up its own times (Laps)
// and hands them in once, when its part is done. Where nobody asks there is no RowTimes, and a lap tests a
// pointer.
#pragma once

#include "sim/base/profile.h"

#include <mutex>
#include <vector>

namespace rend {

class RowTimes {
public:
  explicit RowTimes(std::size_t interactions) : seconds_(interactions), reading_(clock_reading()) {}
  void count() { ++evaluations_; }

  long evaluations() const { return evaluations_; }
  double seconds(std::size_t interaction) const { return seconds_[interaction]; } // of all threads together

  // Of one part of one evaluation.
  class Laps {
  public:
    explicit Laps(RowTimes* times);
    ~Laps();
    Laps(const Laps&) = delete;
    Laps& operator=(const Laps&) = delete;
    void begin() { // what was since the last lap is nobody's
      if (times_) since_ = Clock::now();
    }
    void end(std::size_t interaction) { // what was since begin() or the last lap is its
      if (times_) add(interaction);
    }

  private:
    using Clock = std::chrono::steady_clock;
    void add(std::size_t interaction);
    RowTimes* times_;             // null: nobody asks
    std::vector<double> seconds_; // one per interaction
    Clock::time_point since_;
  };

private:
  void take(const std::vector<double>& seconds);

  std::mutex mutex_;
  std::vector<double> seconds_; // one per interaction
  long evaluations_ = 0;
  double reading_; // [s], of the clock
};

} // namespace rend
