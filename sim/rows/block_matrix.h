// A square sparse matrix of 3 × 3 blocks over vertex slots: what the implicit schemes solve with.
//
// Block-CSR: the blocks of a row stand together, their columns increasing. Row and column i belong to vertex
// slot i; the pattern is symmetric and has every diagonal block, so that a free slot is a row by itself. The
// pattern is shared: it is made when the rows of a program change, and matrices, factors and places of units
// refer to it until it changes.
//
// A block is three columns, each a record of four doubles: y += B x is three multiplications of a record by a
// number. Its fourth components stay 0. Sums run in the order of the columns, and a row has one owner: the
// bytes do not depend on the number of threads.
#pragma once

#include "sim/base/simd.h"

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace rend {

struct BlockPattern {
  std::vector<std::uint32_t> start;    // of each row's blocks; rows + 1
  std::vector<std::uint32_t> column;   // one per block, increasing in a row
  std::vector<std::uint32_t> diagonal; // place of the block (i, i), one per row
  int parts = 1;                       // threads that a product with it is worth

  // Row i holds i and `neighbours[starts[i] .. starts[i + 1])`, in any order and any number of times.
  static BlockPattern of(const std::vector<std::uint32_t>& starts,
                         const std::vector<std::uint32_t>& neighbours);

  std::size_t rows() const { return diagonal.size(); }
  std::size_t blocks() const { return column.size(); }
  std::uint32_t place(std::uint32_t row, std::uint32_t col) const; // CHECK: it is there
  std::size_t bytes() const;
  bool same_as(const BlockPattern& other) const;
};

struct Block3 {
  Record column[3];

  double operator()(int row, int col) const { return (&column[col].x)[row]; }
  double& operator()(int row, int col) { return (&column[col].x)[row]; }
  Eigen::Matrix3d matrix() const;
  static Block3 of(const Eigen::Matrix3d& matrix);
};

REND_INLINE Double4 times(const Block3& b, const Record& x) {
  return load(b.column[0]) * splat(x.x) + load(b.column[1]) * splat(x.y) + load(b.column[2]) * splat(x.z);
}

class BlockMatrix {
public:
  void reset(std::shared_ptr<const BlockPattern> pattern); // all blocks are 0

  const std::shared_ptr<const BlockPattern>& pattern() const { return pattern_; }
  std::size_t rows() const { return pattern_ ? pattern_->rows() : 0; }
  const Block3& at(std::size_t place) const { return value_[place]; }
  Block3& at(std::size_t place) { return value_[place]; }
  const Block3& diagonal(std::size_t row) const { return value_[pattern_->diagonal[row]]; }
  std::span<const Block3> row(std::size_t i) const {
    return {value_.data() + pattern_->start[i], value_.data() + pattern_->start[i + 1]};
  }

  void add_diagonal(std::size_t row, double s); // s times the identity

  // y = A x, one record per row.
  void multiply(const Record* x, Record* y) const;

  // Makes rows and columns of held coordinates those of the identity. `axes`: bits 0, 1, 2 for x, y, z, one per
  // row. With a right side of 0 there, the solution is that of the free coordinates, and 0 at the held ones.
  void hold(const std::uint8_t* axes);

  std::size_t bytes() const { return value_.size() * sizeof(Block3); }

private:
  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<Block3> value_; // one per block of the pattern
};

} // namespace rend
