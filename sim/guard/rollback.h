// A stretch of steps that can be repeated (rollback): the state at its start, and a bound of the work done
// since.
//
// Saving the start costs no copy: when its first step is accepted, the buffers of the old state are put aside,
// and those put aside before take their place (Body::commit swaps two buffers, this rotates three). The
// topology is constant within a stretch: a change begins a new one.
//
// Kinetic and elastic energy K + U can grow by the work of gravity, loads, drives and moving spheres,
//
//   gravity   Σ m g·Δx                                      Δx: displacement since the start
//   loads     Σ f·Δx; Σ |f| |Δx| if they depend on the state or on time           f: at the start
//   drives    Σ (|F| + m |g|) |Δx| + ½ m ω² |Δx|²            over prescribed vertices; F: internal force at the
//                                         start, ω: a bound of the highest frequency (frequency.h)
//   spheres   the same over all vertices, with |V| Δt for |Δx|        for spheres moving as prescribed, with V
//
// and, as headroom, by the energy of prescribed motion: ½ m v² of prescribed vertices, ½ m (2V)² of vertices
// that a sphere may hit, and the velocity gained in two steps under gravity and loads. All are bounded by
// quantities at the start, or known beforehand: none grows as fast as the energy of an exploding motion, which
// therefore does not hide itself.
#pragma once

#include "sim/body/body.h"
#include "sim/outside/world.h"

#include <memory>
#include <vector>

namespace rend {

class Rollback {
public:
  using Bodies = std::vector<std::unique_ptr<Body>>;
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
  Account account();             // of the current state, which is not changed
  double elastic_energy() const; // [J], of the current state; costs about twenty evaluations of the forces

  std::size_t bytes() const;
  void store(Archive& archive, long done); // `done` steps were made; after the bodies

private:
  struct Start { // per body
    State state;
    double time = 0;           // [s]
    std::vector<Record> load;  // [N], one per vertex slot; empty: none
    std::vector<Record> force; // [N], internal, one for each of Constraints::vertices()
    double forces = 0;         // [N], Σ |F| over all vertices if spheres push; else 0
    double omega_squared = 0;  // [1/s²]; 0: the body has no drives
    void store(Archive& archive, const Body& body);
  };
  struct SphereStart {
    Vec3 centre, velocity;
    void store(Archive& archive);
  };
  void check_read(long done) const; // throws ArchiveError
  void add(const Body& body, const Start& start, Account& sum) const;
  void add_loads(Body& body, const Start& start, Account& sum) const;
  void add_drives(const Body& body, const Start& start, Account& sum) const;
  void add_pushes(const Body& body, const Start& start, Account& sum) const;
  double of_gravity(double whole, double from, double until) const; // [J]
  const Record* from(const Body& body, const Start& start) const;   // [m], positions at the start
  bool pushed(const Body& body) const;

  World& world_;
  const Bodies& bodies_;
  double step_;     // [s]
  double push_ = 0; // [m/s], speed of the fastest sphere that moves as prescribed
  long first_ = 0;
  bool aside_ = false;        // whether the start is in starts_, and no longer the current state
  std::vector<Start> starts_; // one per body
  std::vector<SphereStart> spheres_;
};

} // namespace rend
