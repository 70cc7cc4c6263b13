// What the solver runs: flat arrays, a pure function of the body.
//
// Rows of every interaction (packed_rows.h), inverse masses and drag per vertex. Nothing that must survive
// lives here. After an edit, rebind() brings up to date only what the changes concern; the result is byte for
// byte that of building anew (same_as() says so, and a test asks it on every preset).
//
// Two sets of rows, each there only if somebody needs it:
//   folded      parallel springs as one row, forces into vertices: what the integrator evaluates
//   elementary  every spring for itself, forces into element corners: what laws on elements look at
#pragma once

#include "sim/base/threads.h"
#include "sim/mechanics/mass.h"
#include "sim/rows/binder.h"
#include "sim/rows/kernels.h"

#include <memory>
#include <string>

namespace rend {

class RowTimes;

struct ProgramOptions {
  bool folded = true;
  bool elementary = false;
  bool fold = true;  // in the folded set: false (cumulated="no") gives every unit its own row
  bool walk = false; // evaluate by walking the map, as the thesis did: the slow reference
  int threads = 1;
  bool timed = false;          // what the rows of each interaction take
  bool small_in_parts = false; // as many parts as threads however small the body: for tests
};

class Program {
public:
  Program(EmbeddedMap& map, const std::vector<std::unique_ptr<Interaction>>& interactions,
          const MassColumn& mass, const DragColumn* drag, const ProgramOptions& options);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  // Internal forces [N] at the given positions [m] and velocities [m/s], one record per vertex slot.
  void forces(const Record* position, const Record* velocity, Record* force) const;

  // The same, and whole(begin, end) for stretches of vertex slots to which no row is going to add any more:
  // together all, each once. Threads get multiples of `unit` slots each.
  void forces_in_stretches(const Record* position, const Record* velocity, Record* force, std::size_t unit,
                           PartWork whole) const;

  // The same by the elementary rows, each element corner's own share as well: one record per corner slot.
  void corner_forces(const Record* position, const Record* velocity, Record* corner, Record* force) const;

  // Where sums_fit(): forces() with the same bits, and in each record's fourth lane the sum of the sizes of all
  // single forces on the vertex. To be cleared before others read it.
  void forces_with_sums(const Record* position, const Record* velocity, Record* force) const;

  // Of corner_forces(), the shares at corners of vertices with a mark alone; others are undefined.
  void corner_forces_at(const std::vector<std::uint8_t>& mark, const Record* position, const Record* velocity,
                        Record* corner) const;

  void rebind(); // after edits; does nothing where there were none
  void reserve_for_separations();

  std::size_t vertices() const { return inverse_mass_.size(); }                   // slots
  const double* inverse_mass() const { return inverse_mass_.data(); }             // [1/kg], 0: free slot
  const double* drag_rate() const { return drag_ ? drag_rate_.data() : nullptr; } // [1/s], or null

  double elastic_energy(const Record* position) const; // [J], where the interactions have one

  const std::vector<Binder>& folded() const { return folded_; }
  const std::vector<Binder>& elementary() const { return elementary_; }
  const std::vector<Binder>& rows() const { return folded_.empty() ? elementary_ : folded_; } // of either set
  const ProgramOptions& options() const { return options_; }
  RowTimes* folded_times() const { return folded_times_.get(); } // null: nobody asks, or there are none
  RowTimes* elementary_times() const { return elementary_times_.get(); }
  int parts() const; // threads that a step of this size is worth
  std::size_t bytes() const;
  bool same_as(const Program& other) const; // byte for byte

private:
  KernelArguments arguments(const Binder& binder, const Record* position, const Record* velocity,
                            Record* force) const; // all blocks, all vertices
  struct Evaluation {
    bool sums; // forces_with_sums()
    const Record *position, *velocity;
    Record* force;
  };
  void run(const Evaluation& what, std::size_t unit, const PartWork* whole) const;
  void run_part(const Evaluation& what, std::size_t begin, std::size_t end, const PartWork* whole) const;
  void find_tiles() const;
  void weigh_again(); // all masses, and the vertices of corners
  void weigh_changed();
  void weigh_all();
  void weigh(Slot vertex);
  void place_corners();

  EmbeddedMap* map_;
  const std::vector<std::unique_ptr<Interaction>>* interactions_;
  const MassColumn* mass_;
  const DragColumn* drag_;
  ProgramOptions options_;
  Changes changes_;
  std::vector<Binder> folded_, elementary_;
  std::vector<const Kernel*> kernels_;                        // of each interaction
  std::unique_ptr<RowTimes> folded_times_, elementary_times_; // null: nobody asks
  std::vector<double> inverse_mass_;                          // [1/kg], one per vertex slot
  std::vector<Slot>
      corner_vertex_;             // of every element corner slot; no_slot: free; empty without elementary rows
  std::vector<double> drag_rate_; // γ/m [1/s], one per vertex slot; empty without drag
  struct Tile {
    std::uint32_t reached; // no row up to this tile adds to this vertex slot or a later one
    std::uint32_t whole;   // no row of a later tile adds to a vertex slot before this one
  };
  mutable std::vector<Tile> tiles_; // found when they are asked for; empty after changes
};

// Whether forces_with_sums() is there: for springs alone, and not where the map is walked.
bool sums_fit(const std::vector<std::unique_ptr<Interaction>>& interactions, const ProgramOptions& options);

} // namespace rend
