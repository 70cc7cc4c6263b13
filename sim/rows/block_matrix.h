// A square sparse matrix of 3 × 3 blocks over vertex slots, for the implicit schemes.
//
// Block-CSR: the blocks of a row are contiguous, with increasing columns. Row and column i belong to vertex
// slot i; the pattern is symmetric and contains every diagonal block, so that a free slot is an isolated row.
// The pattern is shared by matrices, factors and assembly, and made anew when the rows of a program change.
//
// A block is three columns, each a record of four doubles: y += B x is three multiplications of a record by a
// number. The fourth components are 0. Sums run in the order of the columns, and each row is computed by one
// thread: the bytes do not depend on the number of threads.
#pragma once

#include "sim/base/simd.h"

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace rend {

struct BlockPattern {
  std::vector<std::uint32_t> start;    // first block of each row; rows + 1 entries
  std::vector<std::uint32_t> column;   // one per block, increasing in a row
  std::vector<std::uint32_t> diagonal; // index of the block (i, i), one per row
  int parts = 1;                       // number of threads for a product

  // Row i contains i and `neighbours[starts[i] .. starts[i + 1])`, in any order, with repetitions allowed.
  static BlockPattern of(const std::vector<std::uint32_t>& starts,
                         const std::vector<std::uint32_t>& neighbours);

  std::size_t rows() const { return diagonal.size(); }
  std::size_t blocks() const { return column.size(); }
  std::uint32_t place(std::uint32_t row, std::uint32_t col) const; // index of a block. CHECK: it exists
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
  void reset(std::shared_ptr<const BlockPattern> pattern); // all blocks become 0

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

  // Replaces rows and columns of constrained coordinates by those of the identity. `axes`: bits 0, 1, 2 for x,
  // y, z, one per row. With a right-hand side of 0 there, the solution is that of the free coordinates, and 0
  // at the constrained ones.
  void constrain(const std::uint8_t* axes);

  std::size_t bytes() const { return value_.size() * sizeof(Block3); }

private:
  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<Block3> value_; // one per block of the pattern
};

} // namespace rend
