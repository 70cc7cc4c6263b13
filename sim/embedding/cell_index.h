// The slots of one kind of orbit: which slot each dart's orbit has, and what an edit does to them.
//
// Slots are truth: a slot never moves because of a change elsewhere. When an orbit falls apart, the fragment
// with the smallest dart keeps the slot and the others take new ones; when orbits become one, it keeps the slot
// of its smallest dart. Freed slots are reused, the last freed first. At a full build slots are numbered by
// smallest dart.
#pragma once

#include "sim/embedding/slot_table.h"
#include "sim/topology/gmap.h"
#include "sim/topology/map_edit.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rend {

// What one edit did to the slots of one kind of orbit, in the order in which it is to be applied.
struct SlotEvents {
  std::vector<std::pair<Slot, Slot>> splits; // (whole, new slot of a fragment)
  std::vector<std::pair<Slot, Slot>> merges; // (kept, absorbed)
  std::vector<Slot> births;                  // orbits without any old dart
  std::vector<Slot> deaths;                  // slots without darts, absorbed ones included
  std::vector<Slot> settled;                 // slots of all orbits that hold a touched dart
  std::vector<Dart> moved;                   // darts whose slot is another than before
  void clear();
};

class CellIndex {
public:
  // Numbers all orbits of the map.
  CellIndex(const GMap& map, Orbit orbit);

  Orbit orbit() const { return orbit_; }
  Slot slot(Dart d) const { return slot_of_dart_[d]; }
  Slot find(Dart d) const {
    return d.value < slot_of_dart_.size() ? slot(d) : no_slot;
  }                                                        // for darts too new to have one
  Dart first_dart(Slot s) const { return first_dart_[s]; } // the smallest of the orbit; none: the slot is free
  bool alive(Slot s) const { return static_cast<bool>(first_dart_[s]); }
  std::size_t slots() const { return first_dart_.size(); } // free ones included
  std::size_t count() const { return first_dart_.size() - free_.size(); }
  std::size_t bytes() const;
  void reserve(std::size_t slots) { first_dart_.reserve(slots); }

  // Brings the slots up to date after the changes of `journal`, from the darts that it names alone.
  void update(const GMap& map, const Journal& journal, SlotEvents& events);

  // Whether slots are those of a full build: none is free, and they are in the order of smallest darts.
  bool in_order() const;

  // Makes them so. `from`: the slot that each had before. Orbits know their smallest darts: no orbit is walked.
  void number_anew(const GMap& map, std::vector<Slot>& from);

  // All of it (base/archive.h). ArchiveError: these are no slots of the map.
  void store(Archive& archive, const GMap& map);

  // What is wrong, if anything: every orbit of the map has a slot that no other has, and the slot knows its
  // smallest dart; free slots are listed, each once; removed darts have none.
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
  Slot new_slot();

  Orbit orbit_;
  SlotTable slot_of_dart_;       // no_slot: removed
  std::vector<Dart> first_dart_; // one per slot
  std::vector<Slot> free_;       // reused from the back
};

} // namespace rend
