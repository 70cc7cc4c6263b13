// Which slot each dart has, in four bytes a dart or in one.
//
// The darts of an element stand together, and slots are numbered by smallest dart. So, of orbits that lie
// within an element, the slots of any 64 neighbouring darts lie close together: packed, a byte a dart says how
// far its slot is above the least of those 64. (Of the 55 bytes a dart of torn tetrahedra that saves 9.)
// Separations leave such orbits alone; the first edit that needs more unpacks the table for good.
#pragma once

#include "sim/base/id.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rend {

class Archive;

using Slot = std::uint32_t;
constexpr Slot no_slot = Dart::none_value;

class SlotTable {
public:
  explicit SlotTable(std::size_t darts) : wide_(darts, no_slot) {}

  std::size_t size() const { return wide_.size() + step_.size(); } // darts
  Slot operator[](Dart d) const {
    if (!wide_.empty()) return wide_[d.value];
    const std::uint8_t step = step_[d.value];
    return step == no_step ? no_slot : least_[d.value / group] + step;
  }
  void set(Dart d, Slot slot) {
    if (wide_.empty() && set_step(d, slot)) return;
    wide_[d.value] = slot;
  }
  void resize(std::size_t darts); // new ones have no slot

  void rename(std::span<const Slot> now); // every slot s becomes now[s]
  void pack();                            // does nothing where slots lie too far from each other
  std::size_t bytes() const;              // with room that is kept: it was written to
  void store(Archive& archive,
             std::size_t darts); // all of it (base/archive.h), read for a map of so many darts

private:
  static constexpr std::size_t group = 64;      // darts with a least slot in common
  static constexpr std::uint8_t no_step = 0xff; // of a dart without a slot
  bool set_step(Dart d, Slot slot);             // false: it did not fit, and the table is unpacked now
  void unpack();

  std::vector<Slot> wide_;         // one per dart; empty: packed
  std::vector<Slot> least_;        // packed: one per group
  std::vector<std::uint8_t> step_; // packed: one per dart
};

} // namespace rend
