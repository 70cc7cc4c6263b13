// The energy account of a scene: what is there, what was done to it, and what is missing or too much.
//
//   B = K + U + G + S − W
//
// Kinetic, elastic and gravitational energy, the scheme's shadow term S over free coordinates (Scheme::shadow,
// force_shadow), and the work W of loads, drives and obstacles that move (WorkMeter). Damping, contact, changes
// that release or remove what is strained, and implicit schemes only lower B: what is missing since
// the start is *dissipated*. Nothing may raise it: the largest rise above any earlier value is *gained*,
// without a cause. A rise is to be seen beside the scale of the account, the largest K + U + |W| so far:
// schemes keep B to some order of their step only.
//
// It is sampled, since U costs as much as some evaluations of the forces.
#pragma once

#include "sim/body/work_meter.h"

namespace rend {

class Archive;

struct EnergyState {
  double kinetic = 0, elastic = 0, gravity = 0, shadow = 0; // [J]
  Work work;
  double round_off = 0; // [J], bound of the round-off in the sums above

  double balance() const { return kinetic + elastic + gravity + shadow - work.sum(); }
  double scale() const { return kinetic + std::abs(elastic) + work.size() + round_off; }
};

struct EnergyFigures {
  EnergyState now;
  // [J]: B fell by `dissipated` to its least value, and is above that by `balance`:
  // K + U + G + S = its value at the start + W − dissipated + balance
  double dissipated = 0, balance = 0;
  double gained = 0; // [J], the largest balance so far
  double scale = 0;  // [J]

  double gained_share() const { return scale > 0 ? gained / scale : 0; }
};

// The largest share of gained energy in the scale of the account. A run that exceeds it ends with 76: nothing
// caused what it shows.
constexpr double most_gained_share = 0.1;

class EnergyAccount {
public:
  static constexpr long period = 1024; // steps between samples

  bool open() const { return last_.step >= 0; }
  bool due(long step) const { return !open() || step >= last_.step + period; }
  void add(long step, const EnergyState& state);
  void roll_back(long step);               // samples of later steps never were; of the last one at most
  void restart() { last_ = before_ = {}; } // the state was set
  EnergyFigures figures(const EnergyState& now) const;
  void store(Archive& archive, long done); // ArchiveError

private:
  struct Tally {
    long step = -1;                                     // at which it was sampled; -1: not yet
    double first = 0, least = 0, gained = 0, scale = 0; // [J]: balances, and the scale
    void add(const EnergyState& state);
    void store(Archive& archive, long done);
  };
  Tally last_, before_; // after the last sample, and before it
};

} // namespace rend
