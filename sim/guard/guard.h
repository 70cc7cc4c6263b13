// The guard: a step too large for what happens in it is not the end of a run, nor does it spoil what follows.
//
// Every `period` steps, and at each change of topology, a stretch begins (rewind.h). In each step the guard
// looks at S = Σ |v|², which the integration sums up on its way (State::put): it is not finite where a number
// of the state is not, and only where it exceeds a threshold, some four times what it was lately, energy is
// looked at. A body may hold
//
//   K + U ≤ factor · ( B + what came in since the stretch began + headroom )
//
// where B is what it might hold then: K + U at the start of the run, with all that came in since; from time to
// time it comes down to twice what there is. K alone is asked first: U takes as long as many steps. So an
// instability is found whether it explodes in three steps or grows over thousands, and B never follows it
// upwards.
//
// Where a look finds trouble, the stretch is gone again in 2, 4 ... 1024 parts a step up to the same step; then
// the nominal step returns. If that fails again soon, the parts stay for a while, twice as long each time: each
// failure of the nominal step costs its stretch, and leaves a trace of the motion that would have exploded. A
// single step that is not finite is redone alone first.
//
// A redo holds where energy is close to what may be there, or where half the step leaves the same growth (by a
// tenth). Growth beyond the bound that smaller parts do not change is no matter of the step: contact that
// pushes out, a strain that was there; it is accepted, and B follows. Who sets a state between steps is
// noticed, and not undone. A time scheme that solves, or is adaptive, keeps its energy and parts its steps
// itself: only whether numbers are finite is looked at there.
//
// All hangs on numbers of steps and sums in a fixed order: the same on any number of threads, whatever is
// shown.
#pragma once

#include "sim/base/profile.h"
#include "sim/guard/resolved.h"
#include "sim/guard/rewind.h"
#include "sim/guard/trouble.h"

#include <optional>

namespace rend {

class Guard {
public:
  Guard(World& world, const Rewind::Bodies& bodies, const Scheme& scheme, double step, bool on,
        Profile* profile = nullptr);
  const GuardFigures& figures() const { return figures_; }
  std::size_t bytes() const { return rewind_ ? rewind_->bytes() : 0; }
  bool on() const { return rewind_.has_value(); }

  // What a step tells and asks, in this order; `step`: steps done before it.
  int parts(long step) const;       // it is made in
  bool asks_for_forces() const;     // of the present state: a stretch begins
  void before_laws(long step);      // with its forces
  Trouble before_change(long step); // of topology; may be asked again
  void after_laws(long step);
  void after_part() {
    if (!rewind_) return;
    const Within within(profile_, Phase::Guard);
    rewind_->keep();
  }
  Trouble after_step(long done); // steps done with it

  // Where one of them, or the state, was in trouble, with so many steps done: puts the start of the stretch
  // back, to be gone again to where it was. Returns the steps done there; none: no smaller parts are left, and
  // all is as it is.
  std::optional<long> again(Trouble trouble, long done);
  bool redoing() const { return redoing_; }
  long go_back(); // to the start of the stretch, to be gone in nominal steps; returns the steps done there
  bool has_gone(long done) const { return rewind_ && rewind_->first() < done; } // beyond that start
  void forget();                                                                // all before the present state
  // Between steps, so many of which are done; after the bodies.
  void store(Archive& archive, long done);

private:
  struct Held {
    double energy = 0, limit = 0, given = 0; // [J]
  };
  void check_read(long done) const; // throws ArchiveError
  int usual(long step) const { return step < hold_until_ ? hold_parts_ : 1; }
  // Exactly: the elastic energy is found, however little the kinetic one is.
  enum class Look { AsNeeded, Exactly };
  Trouble settle(long step, Look look);
  Trouble judge(const Rewind::Account& account, Look look);
  double allowed(const Rewind::Account& account) const; // [J]
  Held held(const Rewind::Account& account);
  bool passing(int parts) const;
  bool may_pass() const;
  Trouble end_redo(long done);
  enum class Finer { Helps, DoesNot };
  void go_on(long done, double budget, Finer finer);

  const Rewind::Bodies& bodies_;
  Profile* profile_;             // null: nobody asks
  double step_;                  // [s]
  bool energy_ = false;          // is looked at
  std::optional<Rewind> rewind_; // none: off
  GuardFigures figures_;

  double budget_ = -1;                    // [J], B; < 0: not known yet
  double threshold_ = 0;                  // [m²/s²], of S
  double lately_ = 0;                     // [m²/s²], the largest S of the stretch
  double heaviest_ = 0;                   // [kg], of all vertices
  double calm_ = 0;                       // [J], K when U was last found in order; 0: it needed no look
  double least_rest_ = 0;                 // [m], of neighbours
  bool begins_ = true;                    // a stretch, with the present step
  long settled_ = -1, exactly_ = 0;       // steps done when B was brought up to date, and with U
  bool redoing_ = false;                  // the stretch is gone again ...
  long from_ = 0, goal_ = 0;              // ... in parts between these steps
  int parts_ = 1;                         // ... so many a step
  std::optional<double> start_;           // [J], K + U at its start, if that was asked for
  std::optional<double> growth_;          // [J], of the last try, beyond what came in
  long hold_until_ = 0, hold_length_ = 0; // the parts stay
  int hold_parts_ = 1;
};

} // namespace rend
