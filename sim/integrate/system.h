// The interface of a body for time schemes: m dv/dt = f(x, v) + m g − γ v + loads, dx/dt = v, with some
// vertices prescribed.
#pragma once

#include "sim/base/bytes.h"
#include "sim/base/threads.h"
#include "sim/mechanics/force_law.h"
#include "sim/rows/block_matrix.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace rend {

class Archive;

// A state, read-only.
struct StateView {
  const Record *position, *velocity;
  const Record* acceleration = nullptr; // null: none is known
  bool staggered = false;               // as State has it
};

// Positions [m] and velocities [m/s], one per vertex slot.
struct State {
  std::vector<Record> position, velocity;
  // [m/s²], one per vertex slot, of a scheme that hands it on (Scheme::hands_on_acceleration); 0: none is known
  // (VertexAcceleration). Of other schemes it is empty.
  std::vector<Record> acceleration;
  bool accelerates = false; // it has accelerations
  bool staggered = false;   // velocities are those of the middle of the step before (leapfrog.h)
  void resize(std::size_t vertices) {
    large = vertices > 200000;
    position.resize(vertices);
    velocity.resize(vertices);
    if (accelerates) acceleration.resize(vertices);
  }
  StateView view() const {
    return {position.data(), velocity.data(), accelerates ? acceleration.data() : nullptr, staggered};
  }

  // Writes the new state of a vertex, and accumulates |v|² and a test for finiteness: 0 · x is NaN unless x is
  // finite. In a loop `seen` is a local variable, added to the probe at the end: a sum in memory would
  // serialise the vertices.
  REND_INLINE void write(std::size_t i, Double4 x, Double4 v, Double4& seen) {
    if (large) {
      stream(position[i], x);
      stream(velocity[i], v);
    } else {
      rend::store(position[i], x); // not the one of archives
      rend::store(velocity[i], v);
    }
    seen += v * v + 0.0 * x;
  }
  REND_INLINE void put(std::size_t i, Double4 x, Double4 v) { write(i, x, v, probe); }

  // Σ |v|² over all vertex slots written by put() [m²/s²]; not finite if any number of the state is not.
  double motion() const { return probe[0] + probe[1] + probe[2]; }
  bool finite() const { return std::isfinite(motion()); }
  void probe_all(); // computes it for a state written without put()
  std::size_t bytes() const { return bytes_of(position) + bytes_of(velocity) + bytes_of(acceleration); }
  void store(Archive& archive, std::size_t most); // of at most `most` vertices
  Double4 probe{};
  bool large = false; // larger than the caches: uses streaming stores
};

class System {
public:
  virtual ~System() = default;

  virtual std::size_t vertices() const = 0; // slots
  virtual int parts() const { return 1; }   // number of threads for a loop over all vertices

  // Internal forces [N], one per vertex slot. Updates `load` to the same state.
  virtual void forces(double time, const Record* position, const Record* velocity, Record* force) = 0;

  // The same for a scheme that updates each vertex as soon as its force is complete: calls whole(begin, end)
  // for ranges of vertex slots that cover all, each once and increasing within a thread; no two threads get
  // slots of the same `stretch`. The default calls it once, for all.
  virtual void forces_in_ranges(double time, const Record* position, const Record* velocity, Record* force,
                                RangeFunction whole);
  static constexpr std::size_t range_size = 512; // vertex slots

  // Updates `load` (external forces) only. By default loads do not depend on the state.
  virtual void update_loads(double time, const Record* position, const Record* velocity);

  // Sets prescribed vertices to their positions and velocities at `time`.
  virtual void constrain(double time, Record* position, Record* velocity) = 0;

  // For implicit schemes. The sparsity pattern of stiffness and damping over vertex slots: a new object after a
  // change of topology. By default there is none (CHECK).
  virtual std::shared_ptr<const BlockPattern> pattern();

  // Adds by_position · (−∂f/∂x) + by_velocity · (−∂f/∂v), symmetrised, of the internal forces to a matrix with
  // that pattern.
  virtual void add_stiffness(const Record* position, const Record* velocity, Tangent tangent,
                             double by_position, double by_velocity, BlockMatrix& out);

  // Which coordinates are prescribed at `time`: bits 0, 1, 2 for x, y, z, one per vertex slot; cleared by the
  // caller.
  virtual void mark_prescribed(double time, std::uint8_t* axes);

  // Contact that belongs to the solve, for schemes that solve: after begin_solve(), forces() and
  // add_stiffness() contain it, until the step ends. `end` [s]: of a step or substep of size `step` from
  // `now`; `internal`: forces [N] of `now`, or null if they are not known. By default there is none.
  virtual void begin_solve(double end, double step, const StateView& now, const Record* internal);
  virtual bool in_contact() const { return false; } // since begin_solve(), something is near an obstacle
  // The solve has converged to these positions. True: contact forces have changed by so much that it goes on.
  virtual bool tighten_contact(const Record* position);

  // dv/dt [m/s²] of a free vertex under the internal force f.
  REND_INLINE Double4 acceleration(std::size_t vertex, Double4 f, Double4 v) const {
    double rate = uniform_drag;
    if (drag_rate) rate += drag_rate[vertex];
    if (load) f += rend::load(load[vertex]);
    return f * splat(inverse_mass[vertex]) + rend::load(gravity) - splat(rate) * v;
  }

  const double* inverse_mass = nullptr; // [1/kg], one per vertex slot; 0: free slot
  const double* drag_rate = nullptr;    // γ/m [1/s], one per vertex slot, or null
  double uniform_drag = 0;              // γ/m [1/s], of all vertices
  Record gravity;                       // [m/s²]
  const Record* load = nullptr; // external [N], of the state last evaluated, one per vertex slot, or null
};

} // namespace rend
