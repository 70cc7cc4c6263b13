// Assembly of the sparse tangent matrices −∂f/∂x and −∂f/∂v of the internal forces from the rows of a program.
//
// Two vertices share a block if some row acts on both. The destination of each block of a row's own matrix is
// looked up once, when the rows change; assembly is then one pass over the rows without searching. The pattern
// and these destinations are a pure function of the rows, recomputed when the program was rebound.
//
// Threads own ranges of matrix rows; a unit across the border of two ranges is computed in both, and each
// writes the rows that it owns, so that every block is the sum over its units in their order.
#pragma once

#include "sim/rows/block_matrix.h"
#include "sim/rows/program.h"

namespace rend {

class Assembly {
public:
  Assembly(const EmbeddedMap& map, const Program& program);

  void rebind(); // after the program's rebind()

  const std::shared_ptr<const BlockPattern>& pattern() const { return pattern_; }

  // Adds by_position · (−∂f/∂x) + by_velocity · (−∂f/∂v), symmetrised, at the given positions [m] and
  // velocities [m/s]. The matrix must have this pattern.
  void add(const Record* position, const Record* velocity, Tangent tangent, double by_position,
           double by_velocity, BlockMatrix& out) const;

  std::size_t bytes() const; // including the pattern

private:
  struct Scales {
    double position, velocity;
  };
  void add_rows(std::size_t binder, const Record* x, const Record* v, Tangent tangent, Scales scales,
                std::size_t low, std::size_t high, BlockMatrix& out) const;

  const EmbeddedMap* map_;
  const Program* program_;
  std::shared_ptr<const BlockPattern> pattern_;
  // Destination of each block of each unit, [binder][row][particle][particle]. Entries of unused rows between
  // blocks are 0.
  std::vector<std::vector<std::uint32_t>> place_;
};

} // namespace rend
