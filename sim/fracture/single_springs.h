// The single springs and hinges of a body, of one kind or all, whether or not the program sums parallel ones
// into one row.
//
// The force of a row is not enough: those of parallel springs may cancel. But
//
//   |k_e (l − l0) + λ_e u·w|  ≤  Σk |l − l0| + Σλ |u·w|
//
// for each spring e of the row, since they have the same rest length; single springs are evaluated only if the
// right side exceeds the threshold. Each hinge has a row of its own.
#pragma once

#include "sim/fracture/criterion.h"
#include "sim/rows/current_unit.h"

namespace rend {

class SingleSprings {
public:
  // Those of interactions whose name begins with `kind`; empty: all springs and hinges.
  explicit SingleSprings(const CriterionRequest& request);

  bool empty() const { return of_.empty(); }

  // Calls f(unit) for every unit whose force [N] (moment [N.m] of a hinge) may exceed the threshold, and for
  // some others, in an order that is a function of the map alone.
  template <class F> void each_above(const ForceView& view, double threshold, F&& f) const {
    each_row(view, [&](const Binder& binder, std::size_t key, std::size_t row) {
      if (binder.interaction()->law->particles() == 2 && bound(view, binder.rows(), row) <= threshold) return;
      each_unit(view, binder, key, f);
    });
  }

  // The same for every row whose elongation l/l0 − 1 exceeds the threshold in magnitude.
  template <class F> void each_longer(const ForceView& view, double threshold, F&& f) const {
    each_row(view, [&](const Binder& binder, std::size_t key, std::size_t row) {
      if (std::abs(elongation(view, binder.rows(), row)) > threshold) each_unit(view, binder, key, f);
    });
  }

private:
  template <class F> void each_row(const ForceView& view, F&& f) const {
    for (std::size_t n : of_) {
      const Binder& binder = view.program.rows()[n];
      binder.rows().for_each([&](std::size_t key, std::size_t row) { f(binder, key, row); });
    }
  }
  template <class F> void each_unit(const ForceView& view, const Binder& binder, std::size_t key, F&& f) const {
    thread_local std::vector<std::size_t> keys;
    binder.units_of_row(key, keys);
    for (std::size_t k : keys)
      f(CurrentUnit(view.map, *binder.interaction(),
                    view.map.cells(binder.pattern().owner).first_dart(binder.owner_of(k)),
                    k % static_cast<std::size_t>(binder.units()), view.position, view.velocity));
  }
  static double bound(const ForceView& view, const PackedRows& rows, std::size_t row); // [N]
  static double elongation(const ForceView& view, const PackedRows& rows, std::size_t row);

  std::vector<std::size_t> of_; // indices among the body's interactions
};

// Magnitude of the force [N], of a hinge that of its moment [N.m].
double force_of(const CurrentUnit& spring);

// l/l0 − 1 of a spring.
double elongation_of(const CurrentUnit& spring);

// The kind of cell for springs of this kind, and the cell of a single one, by its smallest dart.
Cell cell_of_kind(std::string_view kind);
Dart cell_of(const EmbeddedMap& map, Cell cell, const CurrentUnit& spring);

// Why the requested `kind` is not possible, as a sentence; empty: it is.
std::string lacking_for_springs(const CriterionRequest& request);

// CriterionType::without_meaning of the criteria on springs.
std::string springs_without_meaning(std::string_view kind, int dimension);

// Whether springs of this kind are hinges, which have a moment and no elongation.
bool turns(const CriterionRequest& request);

// Among candidates from `first` on that have the same dart, keeps the largest; sorted by dart.
void keep_largest(std::vector<Candidate>& candidates, std::size_t first);

} // namespace rend
