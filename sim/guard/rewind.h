// A stretch of steps that can be gone again: the state at its start, and what energy may have come in since.
//
// The start costs no copy. Where a stretch begins, the buffers of the old state are put aside when the step is
// kept, and the ones put aside before take their place (Body::commit swaps two, this a third). Topology does
// not change within a stretch: a change begins one.
//
// Kinetic and elastic energy K + U can grow by what gravity, loads, drives and moving spheres give,
//
//   gravity   Σ m g·Δx                                      Δx: since the start
//   loads     Σ f·Δx; Σ |f| |Δx| where they depend on the state, or on time       f: as they were at the start
//   drives    Σ (|F| + m |g|) |Δx| + ½ m ω² |Δx|²            over prescribed vertices; F: internal force at the
//                                         start, ω: a bound of the highest frequency (frequency.h)
//   spheres   the same over all vertices, with |V| Δt for |Δx|        that move as prescribed, with V
//
// and, on top, by what a state of motion holds that is prescribed: ½ m v² of prescribed vertices, ½ m (2V)² of
// what a sphere may hit, and the kick of two steps under gravity and loads. All are bounded from the start's
// side, or known beforehand: a motion that explodes gains by none of them as fast as its energy grows, and so
// does not excuse itself.
#pragma once

#include "sim/body/body.h"
#include "sim/outside/world.h"

#include <memory>
#include <vector>

namespace rend {

class Rewind {
public:
  using Bodies = std::vector<std::unique_ptr<Body>>;
  static constexpr long longest = 64;                      // steps of a stretch, at most
  Rewind(World& world, const Bodies& bodies, double step); // step [s]
  void reserve_for_separations();

  long first() const { return first_; } // steps done at its start
  void begin(long step);                // here; forces and loads are those of the present state
  void keep();                          // after each commit: puts the start aside, if it is not yet
  bool fits() const;                    // false: somebody has changed the topology since, other than by laws
  void restore();                       // to the start; bodies and spheres

  struct Account {
    double kinetic = 0;            // [J], now
    double given = 0;              // [J], since the start, of either sign
    double headroom = 0;           // [J], on top
    double mass = 0, heaviest = 0; // [kg], of all vertices
    double squared_speeds = 0;     // [m²/s²], of live vertices
  };
  Account account();             // of the present state, which it does not change
  double elastic_energy() const; // [J], of the present state; some twenty times the price of the forces

  std::size_t bytes() const;
  void store(Archive& archive, long done); // so many steps are done; after the bodies

private:
  struct Start { // of a body
    State state;
    double time = 0;           // [s]
    std::vector<Record> load;  // [N], one per vertex slot; empty: none
    std::vector<Record> force; // [N], internal, one for each of Constraints::vertices()
    double forces = 0;         // [N], Σ |F| over all vertices where spheres push; else 0
    double omega_squared = 0;  // [1/s²]; 0: nothing drives the body
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
  const Record* from(const Body& body, const Start& start) const; // [m], positions at the start
  bool pushed(const Body& body) const;

  World& world_;
  const Bodies& bodies_;
  double step_;     // [s]
  double push_ = 0; // [m/s], the fastest of spheres that move as prescribed
  long first_ = 0;
  bool aside_ = false;        // the start is in starts_, and no more the present state
  std::vector<Start> starts_; // one per body
  std::vector<SphereStart> spheres_;
};

} // namespace rend
