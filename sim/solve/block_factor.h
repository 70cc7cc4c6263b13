// A direct solver: A = L D Lᵀ in blocks of 3 × 3, by rows (the up-looking scheme of Davis, "Direct Methods for
// Sparse Linear Systems", 4.7), in a minimum degree ordering (AMD, from Eigen) that depends on the sparsity
// pattern alone.
//
// The ordering, the elimination tree and the structure of L are kept as long as the pattern is the same. Blocks
// save three quarters of the indices and allow four doubles at once. The pivots of D tell the definiteness: all
// positive, some negative (an unstable equilibrium), or one that is 0 to round-off (a mode without stiffness).
#pragma once

#include "sim/rows/block_matrix.h"
#include "sim/solve/vectors.h"

namespace rend {

enum class Definiteness { Positive, Indefinite, Singular };

class BlockFactor {
public:
  // Symbolic factorisation: ordering and structure of L. Does nothing if the pattern has not changed.
  void analyse(const std::shared_ptr<const BlockPattern>& pattern);

  double products() const { return products_; } // number of block products of a factorisation
  std::size_t blocks() const { return total_; } // of L

  // Numeric factorisation. The matrix is symmetric and has the analysed pattern. Singular: there is no factor.
  Definiteness factorise(const BlockMatrix& matrix);

  void solve(const Record* b, Record* x); // A x = b; x may be b

  std::size_t bytes() const;

private:
  void order_by_degree();
  void shape();
  std::size_t reach(std::uint32_t k, const BlockMatrix& matrix);
  int invert(std::uint32_t k, const Block3& diagonal); // −1, 0, 1: the smallest sign of its pivots

  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<std::uint32_t> order_, inverse_;     // row of the matrix at position k, and position of each row
  std::vector<std::uint32_t> parent_;              // of the elimination tree
  std::vector<std::size_t> start_;                 // of the columns of L
  std::vector<std::uint32_t> end_;                 // one past the entries of each column so far
  std::vector<std::uint32_t> row_;                 // row index of each block of L
  std::vector<Block3> lower_;                      // blocks of L below the diagonal, by columns
  std::vector<Block3> pivot_, inverse_pivot_;      // D, D⁻¹
  std::vector<Block3> work_;                       // the current row, one block per column
  std::vector<std::uint32_t> mark_, stack_, path_; // scratch of reach()
  Records solution_;
  double products_ = 0;
  std::size_t total_ = 0;
};

} // namespace rend
