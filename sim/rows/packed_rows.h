// Rows of one interaction, packed for the kernel, and changed one at a time.
//
// A row's key is fixed by the map: owner slot × units + unit. Keys come in blocks of 64, each with a mask of
// its live keys; the live rows of a block stand packed one after the other, in the order of their keys with the
// six low bits turned around:
//
//   block b   keys   64b, 64b+32, 64b+16, 64b+48, 64b+8 ...      mask   1 0 1 1 0 ...
//             rows   key 64b, key 64b+16, key 64b+48, padding to a multiple of four
//
// so that dead rows cost neither time nor memory, an insertion moves at most 63 rows, and what is in the rows
// of which block, in which order, is a pure function of what lives (incremental = from scratch, and the same
// sums to the bit). Blocks stand packed as well, in the order in which they first got rows, with room for a
// multiple of four; one that outgrows its room moves to the end, where it has room for all its keys. (With gaps
// for dead keys the springs of a million quads took twice as long: half the keys of edges are dead, since two
// faces share one row.)
//
// Neighbouring keys are sides of one face and share vertices: turned around, rows that follow each other seldom
// add to the same vertex, and none waits for the sum before it (2.3 against 1.9 µs a step at 10 × 10 quads).
// Padding repeats the last row's indices with values 0: the kernel takes four rows at a time and needs no
// remainder loop. Values of four rows stand together, [row/4][column][row%4], so that a kernel reads one
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

  // `indices` index columns, the first `places` of which are vertex slots that the row writes to; `values`
  // columns, of which one may be `unused` (-1: none): it is 0, and is not kept.
  PackedRows(int indices, int places, int values, int unused = -1);

  void clear();                  // no keys any more; arrays keep their room
  void resize(std::size_t keys); // never fewer; new keys are dead
  void reserve(std::size_t keys);
  void trim(); // once all is bound: gives back room that arrays took on their way
  std::size_t keys() const { return keys_; }
  bool live(std::size_t key) const { return (mask_[key / block_size] >> scattered(key % block_size) & 1) != 0; }
  std::size_t live_count() const;

  void set(std::size_t key, const std::uint32_t* index, const double* value);
  void erase(std::size_t key);
  void seal(); // writes padding and ranges of the blocks that changed; to be called before rows are read

  // The n-th key of a block, n < 64, in the order of its rows: keys that are set so each come behind the one
  // before.
  static std::size_t key_at(std::size_t block, std::size_t n) { return block * block_size + scattered(n); }

  // Where the row of a live key stands.
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
  std::size_t columns() const { return columns_; }                               // of values that are kept
  double value(int column, std::size_t row) const {
    return column == unused_ ? 0 : value_[place(row, kept(column))];
  }

  // The values of rows row .. row + 3 (row a multiple of four): four of column 0, four of column 1, ... as far
  // as kept.
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
  bool same_as(const PackedRows& other) const; // block by block, wherever they stand

private:
  // The six bits of a place in a block, turned around; its own inverse.
  static constexpr std::size_t scattered(std::size_t n) {
    n = (n & 0x15) << 1 | (n & 0x2a) >> 1; // neighbours
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
  std::vector<std::uint8_t> room_;                // [rows], one per block: a multiple of four
  std::vector<Range> range_;                      // one per block
  std::vector<std::vector<std::uint32_t>> index_; // [column][row]
  std::size_t columns_;                           // of values that are kept
  std::vector<double> value_;                     // [row / 4][column][row % 4]
  std::vector<std::size_t> dirty_;                // blocks to be sealed
};

} // namespace rend
