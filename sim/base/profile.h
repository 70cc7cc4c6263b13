// Where the time of a run goes, phase by phase.
//
// One phase is current at any moment. A PhaseScope enters another and returns to the former one when its scope
// ends: each second belongs to the innermost phase alone. Reading the clock takes as long as the forces of a
// small body, so only one step in `sampled` is timed and its seconds are scaled up; changes of topology are
// rare and timed in every step. With a full profile (rend run --profile) every step is timed, and the phases
// add up to the whole; the time that the clock itself takes is subtracted at each change of phase. In a step
// that is not timed a PhaseScope only tests a flag. For the thread that makes the steps.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

namespace rend {

class Archive;

enum class Phase {
  Forces,      // of interactions, in all evaluations
  Loads,       // of loads and wind
  Criteria,    // evaluating the criteria
  Changes,     // of topology, and the updates of embedded values
  Rebinding,   // rows, constraints and criteria after a change
  Integration, // the time scheme alone; of an implicit scheme: its solver
  Stiffness,   // of implicit schemes: assembly of the matrix
  Contact,
  Guard,  // checks, and states kept for a rollback
  Output, // files written at frames
  Rest    // the rest of the time loop
};
constexpr std::size_t phase_count = static_cast<std::size_t>(Phase::Rest) + 1;
const char* name_of(Phase phase);

class Profile {
public:
  struct Spent {
    double seconds = 0;
    long turns = 0; // how often it was entered
  };
  enum class Extent { SampledSteps, EveryStep };
  static constexpr long sampled = 16; // one step in `sampled` is timed

  explicit Profile(Extent extent);
  bool every_step() const { return extent_ == Extent::EveryStep; }
  void restart(); // forgets all; Rest becomes current

  void begin_step(long number); // number: steps done before this one
  void end_step();
  bool timed() const { return state_ == State::Timed; } // whether the present step is

  // up to the last change of phase
  Spent spent(Phase phase) const { return spent_[static_cast<std::size_t>(phase)]; }
  double seconds(Phase phase) const;          // [s], over all steps: estimated from the sampled ones
  double reading() const { return reading_; } // [s] that reading the clock takes
  double total() const;                       // [s] that were timed

  void store(Archive& archive);

private:
  friend class PhaseScope;
  using Clock = std::chrono::steady_clock;
  // Off: the present step is not timed. ChangeOnly: only the change of topology that it is making is timed.
  enum class State { Off, Timed, ChangeOnly };
  static bool always_timed(Phase phase) { return phase == Phase::Changes || phase == Phase::Rebinding; }
  bool enter(Phase phase, Phase& before); // false: not timed, the phase did not change
  void leave(Phase before);
  void switch_to(Phase next);

  Extent extent_;
  State state_ = State::Off;
  std::array<Spent, phase_count> spent_;
  Phase phase_ = Phase::Rest;
  Clock::time_point since_;
  double reading_ = 0; // [s]
  long steps_ = 0, timed_steps_ = 0;
};

// The current phase while the object lives.
class PhaseScope {
public:
  PhaseScope(Profile* profile, Phase phase)
      : profile_(profile && profile->enter(phase, before_) ? profile : nullptr) {}
  ~PhaseScope() {
    if (profile_) profile_->leave(before_);
  }
  PhaseScope(const PhaseScope&) = delete;
  PhaseScope& operator=(const PhaseScope&) = delete;

private:
  Phase before_ = Phase::Rest;
  Profile* profile_; // null: the scope is not timed
};

double clock_reading(); // [s] between two consecutive readings of the clock

} // namespace rend
