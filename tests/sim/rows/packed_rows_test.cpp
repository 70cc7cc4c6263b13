#include "sim/rows/packed_rows.h"

#include "sim/random_meshes.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

namespace rend::packed_rows_test {
namespace {

using meshes::Noise;

struct Row {
  std::array<std::uint32_t, 3> index;
  std::array<double, 2> value;
  bool operator==(const Row&) const = default;
};
using Rows = std::map<std::size_t, Row>; // by key

PackedRows packed(const Rows& rows, std::size_t keys) {
  PackedRows packed(3, 2, 2);
  packed.resize(keys);
  for (const auto& [key, row] : rows) packed.set(key, row.index.data(), row.value.data());
  packed.seal();
  return packed;
}

Rows unpacked(const PackedRows& packed) {
  Rows rows;
  packed.for_each([&](std::size_t key, std::size_t at) {
    EXPECT_EQ(at, packed.row(key));
    Row row{};
    for (int c = 0; c < 3; ++c) row.index[static_cast<std::size_t>(c)] = packed.index(c)[at];
    for (int c = 0; c < 2; ++c) row.value[static_cast<std::size_t>(c)] = packed.value(c, at);
    EXPECT_TRUE(rows.emplace(key, row).second);
  });
  return rows;
}

TEST(PackedRows, hold_what_was_set_and_not_erased) {
  Noise noise(1);
  PackedRows packed_rows(3, 2, 2);
  Rows expected;
  std::size_t keys = 100;
  for (int n = 0; n < 3000; ++n) {
    if (n % 1000 == 999) keys += 90;
    packed_rows.resize(keys);
    for (std::size_t m = 0; m < 1 + noise.below(3); ++m) {
      const std::size_t key = noise.below(keys);
      if (noise.below(5) < 3) {
        const auto i = static_cast<std::uint32_t>(noise.below(1000));
        const Row row{{i, i + 7, i + 1}, {noise(), noise()}};
        packed_rows.set(key, row.index.data(), row.value.data());
        expected[key] = row;
      } else {
        packed_rows.erase(key);
        expected.erase(key);
      }
      EXPECT_EQ(packed_rows.live(key), expected.contains(key));
    }
    packed_rows.seal();
    ASSERT_EQ(unpacked(packed_rows), expected);
    ASSERT_EQ(packed_rows.live_count(), expected.size());
    ASSERT_TRUE(packed_rows.same_as(packed(expected, keys))) << "the layout depends on the past";
  }
}

TEST(PackedRows, know_the_least_and_largest_place_of_each_block) {
  Noise noise(2);
  Rows rows;
  for (int n = 0; n < 150; ++n) {
    const auto i = static_cast<std::uint32_t>(noise.below(1000));
    rows[noise.below(400)] = {{i, i + 7, 5000}, {0, 0}}; // the third index is no vertex
  }
  const PackedRows all = packed(rows, 400);
  for (std::size_t block = 0; block < all.blocks(); ++block) {
    PackedRows::Range range;
    for (const auto& [key, row] : rows) {
      if (key / PackedRows::block_size != block) continue;
      range.low = std::min(range.low, row.index[0]);
      range.high = std::max(range.high, row.index[1]);
    }
    EXPECT_EQ(all.range(block), range);
  }
}

TEST(PackedRows, are_padded_to_whole_lanes_with_rows_that_do_nothing) {
  for (std::size_t count = 1; count <= PackedRows::block_size; ++count) {
    Rows rows;
    for (std::size_t n = 0; n < count; ++n) rows[n] = {{10, 20, 30}, {1, 2}};
    const PackedRows all = packed(rows, 64);
    EXPECT_EQ(all.rows_in(0), count);
    EXPECT_EQ(all.padded_in(0) % PackedRows::lanes, 0u);
    EXPECT_LT(all.padded_in(0), count + PackedRows::lanes);
    for (std::size_t at = count; at < all.padded_in(0); ++at) {
      // unused lanes repeat the index of a live row, so they access valid memory
      EXPECT_EQ(all.index(0)[at], 10u);
      EXPECT_EQ(all.value(0, at), 0);
      EXPECT_EQ(all.value(1, at), 0);
    }
  }
}

TEST(PackedRows, stand_without_gaps_where_they_were_set_in_order) {
  Noise noise(3);
  Rows rows;
  for (std::size_t key = 0; key < 640; ++key)
    if (noise.below(2) == 0) rows[key] = {{1, 2, 3}, {4, 5}};
  const PackedRows all = packed(rows, 640);
  std::size_t end = 0;
  for (std::size_t block = 0; block < all.blocks(); ++block) {
    EXPECT_EQ(all.begin(block), end);
    end += all.padded_in(block);
  }
  EXPECT_EQ(all.end(), end);
}

TEST(PackedRows, that_are_cleared_are_as_new_whatever_was_there) {
  Noise noise(5);
  PackedRows used(3, 2, 2);
  used.resize(700);
  const std::uint32_t index[] = {7, 8, 9};
  const double value[] = {4, 5};
  for (int n = 0; n < 500; ++n) used.set(noise.below(700), index, value);
  used.seal();
  Rows rows;
  for (std::size_t key = 0; key < 300; key += 1 + noise.below(3)) rows[key] = {{1, 2, 3}, {6, 7}};
  const PackedRows fresh = packed(rows, 300);
  used.clear();
  used.resize(300);
  for (const auto& [key, row] : rows) used.set(key, row.index.data(), row.value.data());
  used.seal();
  EXPECT_TRUE(used.same_as(fresh));
  EXPECT_EQ(used.end(), fresh.end());
}

TEST(PackedRows, name_the_keys_of_a_block_in_the_order_of_its_rows) {
  Rows rows;
  for (std::size_t key = 0; key < 128; ++key) rows[key] = {{1, 2, 3}, {4, 5}};
  std::size_t n = 0;
  packed(rows, 128).for_each([&](std::size_t key, std::size_t) {
    EXPECT_EQ(PackedRows::key_at(n / PackedRows::block_size, n % PackedRows::block_size), key);
    ++n;
  });
}

TEST(PackedRows, do_not_keep_a_column_that_is_unused) {
  PackedRows all(3, 2, 3, 1);
  all.resize(64);
  const std::uint32_t index[] = {1, 2, 3};
  const double value[] = {4, 0, 6};
  for (std::size_t key = 0; key < 4; ++key) all.set(key, index, value);
  all.seal();
  for (std::size_t key = 0; key < 4; ++key)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(all.value(c, all.row(key)), value[c]);
  EXPECT_EQ(all.lanes_at(0)[0], 4);
  EXPECT_EQ(all.lanes_at(0)[4], 6);
  EXPECT_EQ(packed({{0, {{1, 2, 3}, {4, 6}}}}, 64).bytes(), all.bytes());
}

TEST(PackedRows, keep_what_the_next_rows_of_a_block_write_apart) {
  // Rows are spread within a block so that neighbours by key, which share vertices, are not adjacent.
  Rows rows;
  for (std::size_t n = 0; n < PackedRows::block_size; ++n) rows[n] = {{0, 0, 0}, {0, 0}};
  std::size_t last = 1000;
  packed(rows, 64).for_each([&](std::size_t key, std::size_t) {
    EXPECT_GT(key > last ? key - last : last - key, 1u);
    last = key;
  });
}

} // namespace
} // namespace rend::packed_rows_test
