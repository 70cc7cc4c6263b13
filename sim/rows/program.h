// What the solver runs: flat arrays, a pure function of the body.
//
// Rows of every interaction (packed_rows.h), inverse masses and drag per vertex. Nothing that must persist is
// stored here. After an edit, rebind() updates only what the changes affect; the result is byte for byte that
// of a full binding (same_as() compares, and a test checks it on every preset).
//
// Two sets of rows, each present only if it is needed:
//   folded      parallel springs summed into one row, forces on vertices: what the integrator evaluates
//   elementary  each spring in a row of its own, forces on element corners: for criteria on elements
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
  bool fold = true;  // in the folded set: false (cumulated="no") gives every unit a row of its own
  bool walk = false; // evaluate by walking the map, as the thesis did: the slow reference
  int threads = 1;
  bool timed = false;                 // measures the time of the rows of each interaction
  bool parallel_small_bodies = false; // as many parts as threads even for small bodies: for tests
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

  // The same, and calls whole(begin, end) for ranges of vertex slots as soon as their forces are complete: the
  // ranges cover all slots, each once. The ranges of threads are multiples of `unit` slots.
  void forces_in_ranges(const Record* position, const Record* velocity, Record* force, std::size_t unit,
                        RangeFunction whole) const;

  // The same from the elementary rows, and the contribution of each element corner as well: one record per
  // corner slot.
  void corner_forces(const Record* position, const Record* velocity, Record* corner, Record* force) const;

  // If sums_available(): forces() with the same bits, and in each record's fourth lane the sum of the
  // magnitudes of all single forces on the vertex. The lane must be cleared before others read the forces.
  void forces_with_sums(const Record* position, const Record* velocity, Record* force) const;

  // As corner_forces(), but only at corners of marked vertices; the other records are undefined.
  void corner_forces_at(const std::vector<std::uint8_t>& mark, const Record* position, const Record* velocity,
                        Record* corner) const;

  void rebind();               // after edits; does nothing if there were none
  void take_up_interactions(); // after some were added behind those of the list that it was made with
  void reserve_for_separations();

  std::size_t vertices() const { return inverse_mass_.size(); }                   // slots
  const double* inverse_mass() const { return inverse_mass_.data(); }             // [1/kg], 0: free slot
  const double* drag_rate() const { return drag_ ? drag_rate_.data() : nullptr; } // [1/s], or null

  double elastic_energy(const Record* position) const; // [J], of the interactions that have a potential

  const std::vector<Binder>& folded() const { return folded_; }
  const std::vector<Binder>& elementary() const { return elementary_; }
  // the set that exists
  const std::vector<Binder>& rows() const { return folded_.empty() ? elementary_ : folded_; }
  const ProgramOptions& options() const { return options_; }
  RowTimes* folded_times() const { return folded_times_.get(); } // null: not measured, or no such rows
  RowTimes* elementary_times() const { return elementary_times_.get(); }
  int parts() const; // threads to use for a step of this size
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
  void run(const Evaluation& what, std::size_t unit, const RangeFunction* whole) const;
  void run_part(const Evaluation& what, std::size_t begin, std::size_t end, const RangeFunction* whole) const;
  void add_rows(const Interaction& interaction);
  void find_tiles() const;
  void recompute_masses(); // all masses, and the vertices of corners
  void update_masses();
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
  std::vector<const Kernel*> kernels_;                        // one per interaction
  std::unique_ptr<RowTimes> folded_times_, elementary_times_; // null: not measured
  std::vector<double> inverse_mass_;                          // [1/kg], one per vertex slot
  // vertex of every element corner slot; no_slot: free; empty without elementary rows
  std::vector<Slot> corner_vertex_;
  std::vector<double> drag_rate_; // γ/m [1/s], one per vertex slot; empty without drag
  struct Tile {
    std::uint32_t reached; // no row up to this tile adds to this vertex slot or a later one
    std::uint32_t whole;   // no row of a later tile adds to a vertex slot before this one
  };
  mutable std::vector<Tile> tiles_; // computed when needed; empty after changes
};

// Whether forces_with_sums() is available: only with springs alone, and not when walking the map.
bool sums_available(const std::vector<std::unique_ptr<Interaction>>& interactions,
                    const ProgramOptions& options);

} // namespace rend
