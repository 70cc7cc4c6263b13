// Binding: from a pattern on the map to rows of indices, and which rows an edit affects.
//
// Binding every owner is the definition; rebinding must give identical bytes. A row depends on the links that
// its words follow and on the slots where they end. So after an edit the rows to rebind are those of
//   - the owners whose own orbit was touched;
//   - for every dart x whose αi changed: the owners that reach x by the part of a word before an i;
//   - for every dart x whose slot changed: the owners that reach x by a whole word;
//   - the owners whose rows are summed with one of these.
// The third case is not covered by touched darts: after a vertex split most darts of the new vertex were not
// touched, but their slot changed.
#pragma once

#include "sim/mechanics/interaction.h"
#include "sim/rows/packed_rows.h"

namespace rend {

// An index column: the slot, in the index space of `orbit`, of the dart that `word[unit]` leads to.
struct IndexColumn {
  std::vector<Word> word; // one per unit
  Orbit orbit;
};

constexpr std::size_t most_columns = 64;

enum class Folding : bool { Off, On };

class Binder {
public:
  // Rows of an interaction: its particles' vertices, and with `corners` also the element corners that take the
  // forces. With Folding::On, units between the same particles share one row.
  static Binder of(const EmbeddedMap& map, const Interaction& interaction, Folding folding,
                   std::optional<Orbit> corners);

  // Rows of a pattern without parameters (criteria).
  Binder(const EmbeddedMap& map, Pattern pattern, std::vector<IndexColumn> columns, int places);

  const PackedRows& rows() const { return rows_; }
  const Pattern& pattern() const { return pattern_; }
  const Interaction* interaction() const { return interaction_; }
  int units() const { return static_cast<int>(pattern_.units.size()); }
  Slot owner_of(std::size_t key) const { return static_cast<Slot>(key / pattern_.units.size()); }

  // Keys of the units in the row of a live key: itself and those summed into it, in increasing order.
  void units_of_row(std::size_t key, std::vector<std::size_t>& keys) const;

  void bind();                         // all owners, in arrays without reserve
  void rebind(const Changes& changes); // the rows affected by the changes; keeps what was reserved
  void reserve_for_separations();      // see EmbeddedMap

private:
  struct Row {
    std::array<std::uint32_t, most_columns> index; // one per column
    const double* value = nullptr;                 // the unit's values; null: the pattern has none
  };
  bool present(Slot owner, std::size_t unit) const;
  bool fill(Slot owner, std::size_t unit, Row& row) const; // false: the unit is not present
  bool same_particles(const Row& a, const Row& b) const;
  bool swapped(const Row& a, const Row& b) const { return a.index[0] != b.index[0]; }
  void find_class(Slot owner, std::size_t unit, const Row& row, std::vector<std::size_t>& keys) const;
  const double* sum_of(const std::vector<std::size_t>& keys, const Row& first) const;
  void write(std::size_t key);
  void bind_all();
  void add_owner(Dart d, std::vector<Slot>& owners);
  void add_owners(const std::vector<Dart>& darts, std::vector<Slot>& owners);
  void reach(const Changes& changes, std::vector<Slot>& owners);
  void add_folding(std::vector<Slot>& owners);

  const EmbeddedMap* map_;
  Pattern pattern_;
  std::vector<IndexColumn> columns_;
  const Interaction* interaction_ = nullptr;
  bool fold_ = false;
  PackedRows rows_;
};

} // namespace rend
