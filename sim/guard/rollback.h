// A stretch of steps that can be repeated (rollback): the state at its start, and the work done since.
//
// Saving the start costs no copy: when its first step is accepted, the buffers of the old state are put aside,
// and those put aside before take their place (Body::commit swaps two buffers, this rotates three). The
// topology is constant within a stretch: a change begins a new one.
//
// Kinetic and elastic energy K + U grow by the work of gravity, loads, drives and obstacles that move: that of
// gravity is
//
//   Σ m g·Δx                     Δx: displacement since the start
//
// and the rest is measured (WorkMeter). Headroom is the velocity gained in two steps under gravity and loads.
#pragma once

#include "sim/guard/state_copy.h"

#include <vector>

namespace rend {

class Rollback {
public:
  using Bodies = StateCopy::Bodies;
  static constexpr long longest = 64;                        // maximal number of steps of a stretch
  Rollback(World& world, const Bodies& bodies, double step); // step [s]
  void reserve_for_separations();

  long first() const { return first_; } // steps done at its start
  void begin(long step);                // at the current state, whose forces and loads are evaluated
  void save_start();                    // after each commit: puts the start aside, unless done
  bool fits() const;                    // false: the topology was changed since, other than by laws
  void restore();                       // the start: bodies and spheres

  struct Account {
    double kinetic = 0;            // [J], of the current state
    double work = 0;               // [J], work done since the start, of either sign
    double headroom = 0;           // [J], in addition
    double mass = 0, heaviest = 0; // [kg], of all vertices
    double squared_speeds = 0;     // [m²/s²], of live vertices
  };
  Account account() const; // of the current state
  // [J], by which the work of an account is less than what the forces of the current state give: costs one
  // evaluation of the forces
  double pending_work() const;
  double elastic_energy() const; // [J], of the current state; costs about twenty evaluations of the forces

  std::size_t bytes() const;
  void store(Archive& archive, long done); // `done` steps were made; after the bodies

private:
  void check_read(long done) const; // throws ArchiveError
  void add(const Body& body, const BodyCopy& start, Account& sum) const;
  void add_loads(const Body& body, Account& sum) const;
  double measured_work() const;                                      // [J], since the start, of all but gravity
  double of_gravity(double whole, double from, double until) const;  // [J]
  const Record* from(const Body& body, const BodyCopy& start) const; // [m], positions at the start

  World& world_;
  const Bodies& bodies_;
  double step_; // [s]
  long first_ = 0;
  bool aside_ = false; // whether the start is in starts_, and no longer the current state
  std::vector<BodyCopy> starts_;
  std::vector<SphereCopy> spheres_;
};

} // namespace rend
