// How fast a clip plays the simulation: the time of the clip, which a viewer's watch shows, and the time of the
// simulation. Slow motion makes more pictures of the same steps; it changes no step.
//
// The speed v is the seconds of simulation that pass in a second of the clip: dt/du = v for a moment t of the
// simulation that is shown at the moment u of the clip, and u = 0 where t = 0. The speed may have keys, which
// stand at times of the simulation, where things happen. Between two of them it changes at a constant rate in
// the clip, as a car brakes; before the first and after the last it is constant. So from a key (t0, u0, v0) to
// the next one (t1, u1, v1), with a = (v1² − v0²) / (2 (t1 − t0)):
//
//   t = t0 + v0 (u − u0) + a (u − u0)² / 2        u = u0 + 2 (t − t0) / (v0 + √(v0² + 2 a (t − t0)))
//
// Both are exact integrals of the speed, made of operations that IEEE 754 fixes: the same on every machine.
// (With a speed that is linear in the time of the simulation most of a slow passage would be spent near its
// lower end.)
#pragma once

#include "sim/base/settings.h"

#include <vector>

namespace rend {

// The speed at a time of the simulation.
struct SpeedKey {
  double at = 0;    // [s], of the simulation
  double speed = 1; // seconds of simulation a second of the clip
  SettingsSource source = {};
};
template <> const Fields<SpeedKey>& fields_of();

constexpr double least_speed = 1e-6, most_speed = 1e6;

class Playback {
public:
  explicit Playback(double speed = 1); // constant; CHECK: above 0
  // `keys` in order of time; without any the speed is constant. UserError (BadInput): two keys at one time, or
  // in another order.
  Playback(double speed, const std::vector<SpeedKey>& keys);

  double simulated(double clip) const; // [s] of the simulation after so many [s] of the clip
  double clip(double simulated) const; // the inverse
  double speed_at(double simulated) const;
  double slowest() const; // speed
  bool is_real_time() const { return pieces_.size() == 1 && pieces_.front().speed == 1; }

private:
  struct Piece {          // up to the start of the next; the last has no end
    double simulated = 0; // [s], where it starts
    double clip = 0;      // [s]
    double speed = 1;     // there
    double change = 0;    // of the speed, a second of the clip [1/s]
    double clip_at(double time) const;
    double speed_at(double time) const;
  };
  void add_key(const SpeedKey& from, const SpeedKey& to);

  std::vector<Piece> pieces_; // at least one, in order
};

} // namespace rend
