// The guard: detects steps that were too large for what happened in them, and redoes them with substeps.
//
// Every `period` steps, and at each change of topology, it saves the state: a new stretch begins (rollback.h).
// In each step it tests S = Σ |v|², which the integration accumulates (State::put): S is not finite if a number
// of the state is not, and only if S exceeds twice its values in the last steps, the energy is tested. A body
// may have
//
//   K + U ≤ factor · ( B + work done on it since the start of the stretch + headroom )
//
// where B is its budget: K + U at the start of the run plus all work done since; from time to time it is
// reduced to twice the actual energy. K alone is tested first, since U costs as much as many steps. So an
// instability is found whether it explodes in three steps or grows over thousands, and B never follows it
// upwards.
//
// If a test fails, the stretch is repeated up to the same step with twice as many substeps per step each time,
// up to 1024; then the nominal step is used again. If that fails again soon, the substeps are kept for a while,
// twice as long each time: each failure of the nominal step costs its stretch, and leaves a trace of the motion
// that would have exploded. A single step that is not finite is first redone alone.
//
// A repetition is accepted if the energy is close to the budget, or if half the step gives the same growth
// (within a tenth). Growth beyond the bound that smaller substeps do not change is not caused by the step
// (contact that pushes out, an initial strain): it is accepted, and B is increased. A state that was set
// between steps is detected and kept. Implicit and adaptive schemes control their energy and substeps
// themselves: for them only finiteness is tested.
//
// Where a law makes elements for which a step that was chosen automatically is too large, all later steps have
// as many substeps as make it stable, of any number (Scene::parts_within); the above holds beyond that.
//
// Everything depends on numbers of steps and on sums in a fixed order: the same for any number of threads,
// whatever is displayed.
#pragma once

#include "sim/base/profile.h"
#include "sim/guard/resolved.h"
#include "sim/guard/rollback.h"
#include "sim/guard/step_failure.h"

#include <algorithm>
#include <optional>

namespace rend {

class Guard {
public:
  static constexpr int most_substeps = 1024; // of a step
  Guard(World& world, const Rollback::Bodies& bodies, const Scheme& scheme, double step, bool on,
        Profile* profile = nullptr);
  const GuardFigures& figures() const { return figures_; }
  std::size_t bytes() const { return rollback_ ? rollback_->bytes() : 0; }
  bool on() const { return rollback_.has_value(); }
  bool begins_at(long step) const { return rollback_ && rollback_->first() == step; } // a stretch
  // Whether the steps that led to the current state will not be redone.
  bool settled() const { return !energy_ || begins_; }

  // The calls of a step, in this order; `step`: steps done before it.
  int substeps(long step) const;        // number of substeps, after the laws
  bool needs_forces() const;            // whether it needs those of the current state: a stretch begins
  void before_laws(long step);          // with the forces of that state
  StepFailure before_change(long step); // of topology; may be called more than once
  void after_laws(long step);
  // Until the next such call, each step in so many substeps at least: elements need smaller ones.
  void divide_steps(int least);
  void after_substep() {
    if (!rollback_) return;
    const PhaseScope within(profile_, Phase::Guard);
    rollback_->save_start();
  }
  StepFailure after_step(long done); // steps done including this one

  // At the end of a run: ends the stretch here, where `done` steps were made.
  StepFailure end_stretch(long done);

  // After one of these, or the state itself, reported trouble at `done` steps: restores the start of the
  // stretch, to be repeated up to the same step. Returns the steps done there; nullopt: no smaller substeps are
  // left, and nothing changed.
  std::optional<long> roll_back(StepFailure failure, long done);
  bool redoing() const { return redoing_; }
  // rollback to the start of the stretch, to continue with nominal steps; returns the steps done there
  long restore_start();
  // whether steps were made since that start
  bool has_advanced(long done) const { return rollback_ && rollback_->first() < done; }
  void discard_start(); // everything before the current state
  // Between steps, `done` of which were made; after the bodies.
  void store(Archive& archive, long done);

private:
  struct EnergyTest {
    double energy = 0, limit = 0, work = 0; // [J]
  };
  void check_read(long done) const; // throws ArchiveError
  int planned_substeps(long step) const {
    return std::max(least_substeps_, step < hold_until_ ? hold_substeps_ : 1);
  }
  // Exactly: the elastic energy is found, however little the kinetic one is.
  enum class Look { AsNeeded, Exactly };
  StepFailure update_budget(long step, Look look);
  StepFailure judge(const Rollback::Account& account, Look look);
  double allowed(const Rollback::Account& account) const; // [J]
  double threshold() const;                               // [m²/s²], by the last steps
  void follow(double motion, long done);
  EnergyTest test_energy(Rollback::Account account);
  bool pass_through(int substeps) const;
  bool may_pass_through() const;
  StepFailure end_redo(long done);
  enum class Finer { Helps, DoesNot };
  void end_rollback(long done, double budget, Finer finer);

  const Rollback::Bodies& bodies_;
  Profile* profile_;                 // null: no profile
  double step_;                      // [s]
  bool energy_ = false;              // whether energy is tested
  std::optional<Rollback> rollback_; // none: off
  GuardFigures figures_;

  double budget_ = -1; // [J], B; < 0: not computed yet
  // What S was and may become. A repetition starts with what was there at the start of the stretch.
  struct Watch {
    double threshold = 0;          // [m²/s²], S below which the energy is not tested
    double lately = 0, before = 0; // [m²/s²], the largest S of the last steps, and of those before
    double calm = 0;               // [J], K when U was last tested and accepted; 0: no test was needed
    void store(Archive& archive);
  };
  Watch watch_, watch_at_start_;
  double heaviest_ = 0;                   // [kg], of all vertices
  double least_rest_ = 0;                 // [m], the smallest rest length of neighbours
  bool begins_ = true;                    // whether a stretch begins with the current step
  long settled_ = -1, exactly_ = 0;       // steps done when B was last updated, and when with U
  bool redoing_ = false;                  // the stretch is being repeated ...
  long from_ = 0, goal_ = 0;              // ... from from_ to goal_ ...
  int substeps_ = 1;                      // ... with this number of substeps per step
  std::optional<double> start_;           // [J], K + U at its start, if computed
  std::optional<double> growth_;          // [J], energy growth of the last attempt, without the work done
  long hold_until_ = 0, hold_length_ = 0; // the substeps are kept until this step, for this many steps
  int hold_substeps_ = 1;
  int least_substeps_ = 1; // of every step
};

} // namespace rend
