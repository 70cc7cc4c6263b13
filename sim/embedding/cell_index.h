// The slots of one kind of orbit: which slot the orbit of each dart has, and how an edit changes the slots.
//
// Slots are part of the state of the map, not derived from it: a slot never moves because of a change
// elsewhere. When an orbit is split, the fragment with the smallest dart keeps the slot and the others take new
// ones; when orbits are merged, the result keeps the slot of its smallest dart. Freed slots are reused, the
// last freed first. When the map is built, slots are numbered in the order of smallest darts.
#pragma once

#include "sim/embedding/slot_table.h"
#include "sim/topology/gmap.h"
#include "sim/topology/map_edit.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rend {

// How one edit changed the slots of one kind of orbit, in the order in which the changes are applied.
struct SlotEvents {
  std::vector<std::pair<Slot, Slot>> splits; // (whole, new slot of a fragment)
  std::vector<std::pair<Slot, Slot>> merges; // (kept, absorbed)
  std::vector<Slot> births;                  // orbits of new darts alone
  std::vector<Slot> deaths;                  // slots that lost all darts, absorbed ones included
  std::vector<Slot> settled;                 // slots of all orbits that contain a touched dart
  std::vector<Dart> moved;                   // darts whose slot changed
  void clear();
  bool beyond_splits() const { return !(births.empty() && merges.empty() && deaths.empty() && reused.empty()); }

  // What CellIndex::rollback() needs besides.
  struct Origin {
    Slot from;
    std::uint32_t end; // index in `moved`
  };
  std::vector<Origin> origins;                // of `moved`: up to `end`, darts had the slot `from`
  std::vector<std::pair<Dart, Slot>> lost;    // removed darts, and the slot of each
  std::vector<std::pair<Slot, Dart>> renamed; // slots whose smallest dart changed, and which it was
  std::vector<Slot> reused;                   // new slots that were free, in the order in which they were taken
  std::size_t slots_before = 0, buried = 0;   // number of slots; how many of `deaths` are in the free list
};

class CellIndex {
public:
  // Numbers all orbits of the map.
  CellIndex(const GMap& map, Orbit orbit);

  Orbit orbit() const { return orbit_; }
  Slot slot(Dart d) const { return slot_of_dart_[d]; }
  Slot find(Dart d) const {
    return d.value < slot_of_dart_.size() ? slot(d) : no_slot;
  }                                                        // no_slot for darts that are too new to have one
  Dart first_dart(Slot s) const { return first_dart_[s]; } // the smallest of the orbit; none: the slot is free
  bool alive(Slot s) const { return static_cast<bool>(first_dart_[s]); }
  std::size_t slots() const { return first_dart_.size(); } // free ones included
  std::size_t count() const { return first_dart_.size() - free_.size(); }
  std::size_t bytes() const;
  void reserve(std::size_t slots) { first_dart_.reserve(slots); }
  void reserve_darts(std::size_t darts) { slot_of_dart_.reserve(darts); } // for a map that grows

  // Updates the slots after the changes of `journal`; visits only the orbits of the darts listed there.
  // If memory is exhausted on the way, rollback() with the events as they are then is due.
  void update(const GMap& map, const Journal& journal, SlotEvents& events);

  // After the last update, whose events these are: either the slots and the list of free ones become what they
  // were before it, to the last byte; or they stay, and what rollback() needs is given up.
  void rollback(const SlotEvents& events) noexcept;
  void commit() noexcept { slot_of_dart_.end_edit(); }

  // Whether the slots are those of a newly built map: none is free, and they are in the order of smallest
  // darts.
  bool in_order() const;

  // Renumbers them so. `from`: the slot that each had before. Uses the stored smallest darts: no orbit is
  // walked.
  void renumber(const GMap& map, std::vector<Slot>& from);

  // Writes or reads everything (base/archive.h). ArchiveError: not the slots of this map.
  void store(Archive& archive, const GMap& map);

  // The first inconsistency, if any: every orbit of the map has a slot of its own, which stores its smallest
  // dart; every free slot is listed once; removed darts have none.
  std::optional<std::string> fault(const GMap& map) const;

private:
  struct Fragment;
  std::optional<std::string> fault_of_free() const;
  void number(const GMap& map);
  void find_fragments(const GMap& map, const Journal& journal, std::vector<Fragment>& fragments);
  Fragment fragment_at(const GMap& map, Dart d) const;
  void settle(const Fragment& fragment, SlotEvents& events);
  Slot slot_for(const Fragment& fragment, SlotEvents& events);
  void bury(SlotEvents& events);
  Slot new_slot(SlotEvents& events);
  void set_first(Slot slot, Dart first, SlotEvents& events);

  Orbit orbit_;
  SlotTable slot_of_dart_;       // no_slot: removed
  std::vector<Dart> first_dart_; // one per slot
  std::vector<Slot> free_;       // reused from the back
};

} // namespace rend
