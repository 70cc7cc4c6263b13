// Where the time of a run goes, phase by phase.
//
// One phase is current at any moment. Within turns to another, and back where it ends: each second belongs to
// the innermost phase alone. Reading the clock takes as long as a small body's forces: so only one step in
// `sampled` is timed, and its seconds count that often; what changes the topology is rare, and timed in every
// step. Who asks for a profile (rend run --profile) has every step timed, and then all phases together are the
// whole; what a reading of the clock takes is taken off at each turn. In a step that is not timed a Within
// tests a flag. For the thread that makes the steps.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

namespace rend {

class Archive;

enum class Phase {
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
constexpr std::size_t phase_count = static_cast<std::size_t>(Phase::Rest) + 1;
const char* name_of(Phase phase);

class Profile {
public:
  struct Spent {
    double seconds = 0;
    long turns = 0; // to it
  };
  enum class Extent { SampledSteps, EveryStep };
  static constexpr long sampled = 16; // one step in so many

  explicit Profile(Extent extent);
  bool every_step() const { return extent_ == Extent::EveryStep; }
  void restart(); // forgets all; Rest is current

  void begin_step(long number); // steps done before it
  void end_step();
  bool timed() const { return state_ == State::Timed; } // the present step is

  Spent spent(Phase phase) const { return spent_[static_cast<std::size_t>(phase)]; } // up to the last turn
  double seconds(Phase phase) const;          // [s], over all steps: of sampled ones, scaled up
  double reading() const { return reading_; } // [s] that the clock takes
  double total() const;                       // [s], of what was timed

  void store(Archive& archive);

private:
  friend class Within;
  using Clock = std::chrono::steady_clock;
  // Off: the present step is not timed. AChange: nor is it, but for the change of topology it is making.
  enum class State { Off, Timed, AChange };
  static bool always(Phase phase) { return phase == Phase::Changes || phase == Phase::Rebinding; }
  bool enter(Phase phase, Phase& before); // false: it is not timed, and nothing was turned
  void leave(Phase before);
  void turn_to(Phase next);

  Extent extent_;
  State state_ = State::Off;
  std::array<Spent, phase_count> spent_;
  Phase phase_ = Phase::Rest;
  Clock::time_point since_;
  double reading_ = 0; // [s]
  long steps_ = 0, timed_steps_ = 0;
};

// The phase of a scope.
class Within {
public:
  Within(Profile* profile, Phase phase)
      : profile_(profile && profile->enter(phase, before_) ? profile : nullptr) {}
  ~Within() {
    if (profile_) profile_->leave(before_);
  }
  Within(const Within&) = delete;
  Within& operator=(const Within&) = delete;

private:
  Phase before_ = Phase::Rest;
  Profile* profile_; // null: the scope is not timed
};

double clock_reading(); // [s] between two readings of the clock that follow each other

} // namespace rend
