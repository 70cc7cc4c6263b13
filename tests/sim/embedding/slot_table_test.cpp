#include "sim/embedding/slot_table.h"

#include "sim/base/archive.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

namespace rend::slot_table_test {
namespace {

// As for elements: four slots for each 24 darts, some darts removed.
std::vector<Slot> slots_of_elements(std::size_t darts) {
  std::vector<Slot> slots;
  for (std::uint32_t d = 0; d < darts; ++d) slots.push_back(d % 97 == 5 ? no_slot : 4 * (d / 24) + d % 4);
  return slots;
}

SlotTable table_of(const std::vector<Slot>& slots) {
  SlotTable table(slots.size());
  for (std::uint32_t d = 0; d < slots.size(); ++d) table.set(Dart{d}, slots[d]);
  return table;
}

void expect_same(const SlotTable& table, const std::vector<Slot>& slots) {
  ASSERT_EQ(table.size(), slots.size());
  for (std::uint32_t d = 0; d < slots.size(); ++d) ASSERT_EQ(table[Dart{d}], slots[d]) << d;
}

TEST(SlotTable, holds_the_same_packed_in_a_quarter_of_the_bytes) {
  const std::vector<Slot> slots = slots_of_elements(10000);
  SlotTable table = table_of(slots);
  expect_same(table, slots);
  EXPECT_EQ(table.bytes(), 40000);
  table.pack();
  expect_same(table, slots);
  EXPECT_LE(table.bytes(), 10640);
}

TEST(SlotTable, stays_wide_where_slots_lie_far_apart) {
  std::vector<Slot> slots = slots_of_elements(1000);
  slots[500] = 100000;
  SlotTable table = table_of(slots);
  table.pack();
  expect_same(table, slots);
  EXPECT_EQ(table.bytes(), 4000);
}

// Whatever is set afterwards: no slot, a nearby one, a distant one, more darts.
TEST(SlotTable, is_the_same_as_a_plain_array_whatever_is_set) {
  std::vector<Slot> slots = slots_of_elements(3000);
  SlotTable table = table_of(slots);
  table.pack();
  std::mt19937 random(3);
  const auto set = [&](std::uint32_t d, Slot slot) { table.set(Dart{d}, slots[d] = slot); };
  for (int n = 0; n < 300; ++n) set(static_cast<std::uint32_t>(random() % 3000), no_slot);
  for (std::uint32_t d = 0; d < 3000; d += 7) set(d, 4 * (d / 24) + 3);
  expect_same(table, slots);
  EXPECT_LT(table.bytes(), 4000) << "it is packed still";
  set(40, 2999);
  expect_same(table, slots);
  slots.resize(3500, no_slot);
  table.resize(3500);
  expect_same(table, slots);
  set(3400, 5);
  expect_same(table, slots);
}

// Reads over a small table, over a large one, and back.
TEST(SlotTable, is_stored_as_it_is_and_takes_no_more_room_where_it_is_read) {
  const std::vector<Slot> slots = slots_of_elements(2000);
  SlotTable wide = table_of(slots), packed = table_of(slots), small(5), once_packed = table_of(slots);
  packed.pack();
  once_packed.pack();
  for (const auto& [from, to] : {std::pair{&packed, &small}, {&packed, &wide}, {&wide, &once_packed}}) {
    SlotTable other = *to;
    Archive out;
    from->store(out, from->size());
    Archive in{std::span<const std::uint8_t>(out.bytes())};
    other.store(in, from->size());
    expect_same(other, slots);
    EXPECT_EQ(other.bytes(), from->bytes());
  }
}

TEST(SlotTable, renames_slots_packed_or_not) {
  std::vector<Slot> slots = slots_of_elements(2000), now(slots.size());
  for (Slot s = 0; s < now.size(); ++s) now[s] = static_cast<Slot>(now.size() - 1 - s);
  SlotTable wide = table_of(slots), packed = table_of(slots);
  packed.pack();
  wide.rename(now);
  packed.rename(now);
  for (Slot& slot : slots)
    if (slot != no_slot) slot = now[slot];
  expect_same(wide, slots);
  expect_same(packed, slots);
}

} // namespace
} // namespace rend::slot_table_test
