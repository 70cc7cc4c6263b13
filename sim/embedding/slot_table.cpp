#include "sim/embedding/slot_table.h"

#include "sim/base/archive.h"
#include "sim/base/bytes.h"

#include <algorithm>
#include <utility>

namespace rend {

void SlotTable::pack() {
  std::vector<Slot> least((wide_.size() + group - 1) / group, no_slot);
  for (std::size_t d = 0; d < wide_.size(); ++d) least[d / group] = std::min(least[d / group], wide_[d]);
  std::vector<std::uint8_t> step(wide_.size(), no_step);
  for (std::size_t d = 0; d < wide_.size(); ++d) {
    if (wide_[d] == no_slot) continue;
    const Slot above = wide_[d] - least[d / group];
    if (above >= no_step) return;
    step[d] = static_cast<std::uint8_t>(above);
  }
  least_ = std::move(least);
  step_ = std::move(step);
  wide_ = std::vector<Slot>(); // assigning {} would keep the capacity
}

void SlotTable::unpack() {
  std::vector<Slot> wide(step_.size());
  for (std::size_t d = 0; d < wide.size(); ++d) wide[d] = (*this)[Dart{d}];
  wide_ = std::move(wide);
  least_before_ = std::exchange(least_, {});
  step_before_ = std::exchange(step_, {});
}

void SlotTable::forget() noexcept {
  least_before_ = std::vector<Slot>(); // assigning {} would keep the capacity
  step_before_ = std::vector<std::uint8_t>();
}

void SlotTable::rollback() noexcept {
  if (!step_before_.empty()) {
    wide_ = std::vector<Slot>();
    least_ = std::exchange(least_before_, {});
    step_ = std::exchange(step_before_, {});
  } else if (!wide_.empty()) {
    wide_.resize(size_before_);
  }
}

bool SlotTable::set_step(Dart d, Slot slot) {
  // wraps to a large number if the slot is smaller
  const Slot above = slot == no_slot ? no_step : slot - least_[d.value / group];
  if (slot == no_slot || above < no_step) {
    step_[d.value] = static_cast<std::uint8_t>(above);
    return true;
  }
  unpack();
  return false;
}

void SlotTable::resize(std::size_t darts) {
  if (darts == size()) return;
  if (wide_.empty()) unpack();
  wide_.resize(darts, no_slot);
}

void SlotTable::reserve(std::size_t darts) {
  if (wide_.empty()) unpack();
  forget();
  wide_.reserve(darts);
}

void SlotTable::rename(std::span<const Slot> now) {
  if (wide_.empty()) unpack();
  forget(); // no edit is open
  for (Slot& slot : wide_)
    if (slot != no_slot) slot = now[slot];
}

std::size_t SlotTable::bytes() const {
  return bytes_of(wide_) + bytes_of(least_) + bytes_of(step_);
}

void SlotTable::store(Archive& archive, std::size_t darts) {
  constexpr const char* what = "a table of slots is longer than its map";
  archive.list(wide_, darts, what);
  archive.list(least_, darts, what);
  archive.list(step_, darts, what);
  if (!archive.reading()) return;
  const bool wide = wide_.size() == darts && least_.empty() && step_.empty();
  const bool packed = wide_.empty() && step_.size() == darts && least_.size() == (darts + group - 1) / group;
  refuse_unless(wide || packed, "a table of slots is shorter than its map");
  wide_.shrink_to_fit(); // the arrays of the other form would keep their capacity
  least_.shrink_to_fit();
  step_.shrink_to_fit();
}

} // namespace rend
