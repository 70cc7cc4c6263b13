// From the rows of a program to a sparse matrix: −∂f/∂x and −∂f/∂v of the internal forces.
//
// Two vertices share a block where some row acts on both. Where each block of a row's own matrix goes is looked
// up once, when the rows change; to assemble is then one pass over the rows without a search. Pattern and
// places are a pure function of the rows, made anew when the program was rebound and kept in between.
//
// Threads own ranges of matrix rows; a unit that reaches across a border is computed on both sides, and each
// writes what it owns, so that every block is the sum of its units in their order.
#pragma once

#include "sim/rows/block_matrix.h"
#include "sim/rows/program.h"

namespace rend {

class Assembly {
public:
  Assembly(const EmbeddedMap& map, const Program& program);

  void rebind(); // after the program's

  const std::shared_ptr<const BlockPattern>& pattern() const { return pattern_; }

  // Adds by_position · (−∂f/∂x) + by_velocity · (−∂f/∂v), symmetrised, at the given positions [m] and
  // velocities [m/s]. The matrix has this pattern.
  void add(const Record* position, const Record* velocity, Tangent tangent, double by_position,
           double by_velocity, BlockMatrix& out) const;

  std::size_t bytes() const; // with the pattern

private:
  struct Scales {
    double position, velocity;
  };
  void add_rows(std::size_t binder, const Record* x, const Record* v, Tangent tangent, Scales scales,
                std::size_t low, std::size_t high, BlockMatrix& out) const;

  const EmbeddedMap* map_;
  const Program* program_;
  std::shared_ptr<const BlockPattern> pattern_;
  // Places in the matrix of the blocks of each unit, [binder][row][particle][particle]. Gaps between blocks of
  // rows are 0.
  std::vector<std::vector<std::uint32_t>> place_;
};

} // namespace rend
