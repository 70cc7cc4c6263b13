// Which slot each dart has, in four bytes per dart or in one.
//
// The darts of an element have consecutive numbers, and slots are numbered by smallest dart. So for orbits
// within an element, the slots of any 64 consecutive darts lie close together: in packed form, one byte per
// dart stores the difference to the smallest slot of its group of 64. (This saves 9 of the 55 bytes per dart of
// torn tetrahedra.) Separations leave such orbits alone; the first edit that needs a larger difference unpacks
// the table for good.
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
  void resize(std::size_t darts);  // new ones have no slot
  void reserve(std::size_t darts); // and unpacks the table, as the first new dart would. Between edits

  // Between begin_edit() and end_edit() rollback() makes the table as long as it was, and packed again if it
  // was. It restores no slots: they are to be set again.
  void begin_edit() { size_before_ = size(); }
  void end_edit() noexcept {
    if (!step_before_.empty()) forget();
  }
  void rollback() noexcept;

  void rename(std::span<const Slot> now); // every slot s becomes now[s]
  void pack();                            // does nothing if the slots of some group lie too far apart
  std::size_t bytes() const;              // without what is reserved: it was not written to
  void store(Archive& archive,
             std::size_t darts); // everything (base/archive.h), read for a map of `darts` darts

private:
  static constexpr std::size_t group = 64;      // darts per smallest slot
  static constexpr std::uint8_t no_step = 0xff; // a dart without a slot
  bool set_step(Dart d, Slot slot);             // false: it did not fit, and the table is now unpacked
  void unpack();
  void forget() noexcept;

  std::vector<Slot> wide_;         // one per dart; empty: packed
  std::vector<Slot> least_;        // packed: one per group
  std::vector<std::uint8_t> step_; // packed: one per dart

  std::size_t size_before_ = 0; // of the edit
  std::vector<Slot> least_before_;
  std::vector<std::uint8_t> step_before_; // not empty: the edit unpacked the table
};

} // namespace rend
