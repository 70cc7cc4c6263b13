// Rows of one interaction, packed for the kernel, and changed one at a time.
//
// The key of a row is fixed by the map: owner slot × units + unit. Keys come in blocks of 64, each with a mask
// of its live keys; the live rows of a block are packed one after the other, ordered by their keys with the six
// low bits permuted:
//
//   block b   keys   64b, 64b+32, 64b+16, 64b+48, 64b+8 ...      mask   1 0 1 1 0 ...
//             rows   key 64b, key 64b+16, key 64b+48, padding to a multiple of four
//
// so that dead keys cost neither time nor memory, an insertion moves at most 63 rows, and the rows of each
// block and their order are a pure function of the set of live keys (incremental = from scratch, and the same
// sums to the bit). Blocks are packed as well, in the order in which they first got rows, with capacity for a
// multiple of four; one that outgrows its capacity moves to the end, where it gets capacity for all its keys.
// (With gaps for dead keys the springs of a million quads took twice as long: half the keys of edges are dead,
// since two faces share one row.)
//
// Adjacent keys are sides of one face and share vertices: with permuted bits, consecutive rows rarely add to
// the same vertex, so that none waits for the previous sum (1.9 instead of 2.3 µs per step at 10 × 10 quads).
// Padding repeats the last row's indices with values 0: the kernel takes four rows at a time and needs no
// remainder loop. The values of four rows are interleaved, [row/4][column][row%4], so that a kernel reads one
// stream, whether a row has 3 values (a spring) or 200 (a hexahedron).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace rend {

class PackedRows {
public:
  static constexpr std::size_t block_size = 64;
  static constexpr std::size_t lanes = 4;

  // `indices`: index columns, the first `places` of which are vertex slots that the row writes to; `values`:
  // value columns, one of which may be `unused` (-1: none): it is 0 and not stored.
  PackedRows(int indices, int places, int values, int unused = -1);

  void clear();                  // removes all keys; arrays keep their capacity
  void resize(std::size_t keys); // never fewer; new keys are dead
  void reserve(std::size_t keys);
  void trim(); // after binding everything: releases excess capacity
  std::size_t keys() const { return keys_; }
  bool live(std::size_t key) const { return (mask_[key / block_size] >> scattered(key % block_size) & 1) != 0; }
  std::size_t live_count() const;

  void set(std::size_t key, const std::uint32_t* index, const double* value);
  void erase(std::size_t key);
  void seal(); // writes padding and ranges of the changed blocks; must be called before rows are read

  // The n-th key of a block, n < 64, in the order of rows: setting keys in this order only appends.
  static std::size_t key_at(std::size_t block, std::size_t n) { return block * block_size + scattered(n); }

  // The row of a live key.
  std::size_t row(std::size_t key) const {
    const std::uint64_t below = (std::uint64_t{1} << scattered(key % block_size)) - 1;
    return begin_[key / block_size] + std::popcount(mask_[key / block_size] & below);
  }

  std::size_t blocks() const { return mask_.size(); }
  std::uint64_t mask(std::size_t block) const { return mask_[block]; }
  std::size_t begin(std::size_t block) const { return begin_[block]; } // its first row, a multiple of four
  std::size_t end() const { return end_; }                             // of all rows
  std::size_t rows_in(std::size_t block) const { return std::popcount(mask_[block]); }
  std::size_t padded_in(std::size_t block) const { return (rows_in(block) + lanes - 1) / lanes * lanes; }

  const std::uint32_t* index(int column) const { return index_[column].data(); } // one per row
  std::size_t columns() const { return columns_; }                               // stored value columns
  double value(int column, std::size_t row) const {
    return column == unused_ ? 0 : value_[place(row, kept(column))];
  }

  // The values of rows row .. row + 3 (row a multiple of four): four of column 0, four of column 1, ... without
  // the unused column.
  const double* lanes_at(std::size_t row) const { return value_.data() + place(row, 0); }

  // Smallest and largest vertex slot that rows of the block write to.
  struct Range {
    std::uint32_t low = std::numeric_limits<std::uint32_t>::max(), high = 0;
    bool operator==(const Range&) const = default;
  };
  Range range(std::size_t block) const { return range_[block]; }

  // Calls f(key, row) for every live row in the order of rows.
  template <class F> void for_each(F&& f) const {
    for (std::size_t block = 0; block < mask_.size(); ++block) {
      std::size_t at = begin_[block];
      for (std::uint64_t rest = mask_[block]; rest; rest &= rest - 1)
        f(key_at(block, std::countr_zero(rest)), at++);
    }
  }

  std::size_t bytes() const;
  bool same_as(const PackedRows& other) const; // block by block, wherever the blocks are in memory

private:
  // Permutes the six bits of a position in a block; its own inverse.
  static constexpr std::size_t scattered(std::size_t n) {
    n = (n & 0x15) << 1 | (n & 0x2a) >> 1; // adjacent bits
    return (n & 0x03) << 4 | (n & 0x0c) | (n & 0x30) >> 4;
  }

  std::size_t place(std::size_t row, int column) const {
    return row / lanes * lanes * columns_ + static_cast<std::size_t>(column) * lanes + row % lanes;
  }
  int kept(int column) const { return column - (unused_ >= 0 && column > unused_ ? 1 : 0); }
  void make_room(std::size_t block);
  void lengthen(std::size_t rows);
  void copy_values(std::size_t from, std::size_t to);
  void shift(std::size_t from, std::size_t end, int by);
  void touch(std::size_t block);

  int places_, unused_;
  std::size_t keys_ = 0, end_ = 0;
  std::vector<std::uint64_t> mask_;               // one per block
  std::vector<std::size_t> begin_;                // one per block
  std::vector<std::uint8_t> room_;                // capacity [rows], one per block: a multiple of four
  std::vector<Range> range_;                      // one per block
  std::vector<std::vector<std::uint32_t>> index_; // [column][row]
  std::size_t columns_;                           // stored value columns
  std::vector<double> value_;                     // [row / 4][column][row % 4]
  std::vector<std::size_t> dirty_;                // blocks to be sealed
};

} // namespace rend
