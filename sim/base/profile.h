// Where the time of a run goes, stage by stage, for those who ask (rend run --profile).
//
// One stage is current at any moment. Within turns to another, and back where it ends: each second belongs to
// the innermost stage alone, and all stages together are the whole. Reading the clock takes as long as a small
// body's forces: what a reading takes is measured and taken off at each turn. Where nobody asks there is no
// Profile, and a Within tests a pointer. For the thread that makes the steps.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

namespace rend {

enum class Stage {
  Forces,      // of interactions, in all evaluations
  Loads,       // of loads and wind
  Criteria,    // what the laws look at
  Changes,     // of topology, with embeddings
  Rebinding,   // rows, constraints and laws after a change
  Integration, // of the scheme alone; of one that solves: its solver
  Stiffness,   // of schemes that solve: the matrix
  Contact,
  Guard,  // what it looks at and keeps
  Output, // what is written at frames
  Rest    // of the time loop
};
constexpr std::size_t stage_count = static_cast<std::size_t>(Stage::Rest) + 1;
const char* name_of(Stage stage);

class Profile {
public:
  struct Spent {
    double seconds = 0;
    long turns = 0; // to it
  };

  Profile();
  void restart();            // forgets all; Rest is current
  Stage turn_to(Stage next); // returns the one before
  Spent spent(Stage stage) const { return spent_[static_cast<std::size_t>(stage)]; } // up to the last turn
  double reading() const { return reading_; }                                        // [s] that the clock takes
  double total() const;                                                              // [s]

private:
  using Clock = std::chrono::steady_clock;
  std::array<Spent, stage_count> spent_;
  Stage stage_ = Stage::Rest;
  Clock::time_point since_;
  double reading_ = 0; // [s]
};

class Within {
public:
  Within(Profile* profile, Stage stage) : profile_(profile) {
    if (profile_) before_ = profile_->turn_to(stage);
  }
  ~Within() {
    if (profile_) profile_->turn_to(before_);
  }
  Within(const Within&) = delete;
  Within& operator=(const Within&) = delete;

private:
  Profile* profile_; // null: nobody asks
  Stage before_ = Stage::Rest;
};

double clock_reading(); // [s] between two readings of the clock that follow each other

} // namespace rend
