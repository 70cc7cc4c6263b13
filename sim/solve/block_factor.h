// A direct solver: A = L D Lᵀ in blocks of 3 × 3, by rows (the up-looking scheme of Davis, "Direct Methods for
// Sparse Linear Systems", 4.7), in an order of minimum degree (AMD, of Eigen) that depends on the pattern
// alone.
//
// The order, the elimination tree and the places of L are kept while the pattern is. Blocks spare three
// quarters of the indices and let four doubles work at once. D's pivots tell what kind of matrix it is: all
// positive, some negative (a state that would leave by itself), or one that is 0 to round-off (a motion that
// nothing resists).
#pragma once

#include "sim/rows/block_matrix.h"
#include "sim/solve/vectors.h"

namespace rend {

enum class Definiteness { Positive, Indefinite, Singular };

class BlockFactor {
public:
  // The order and the shape of L. Does nothing where the pattern is the one it knows.
  void analyse(const std::shared_ptr<const BlockPattern>& pattern);

  double products() const { return products_; } // of blocks, to factorise
  std::size_t blocks() const { return total_; } // of L

  // The matrix is symmetric and has the pattern that was analysed. Singular: there is no factor.
  Definiteness factorise(const BlockMatrix& matrix);

  void solve(const Record* b, Record* x); // A x = b; may be the same

  std::size_t bytes() const;

private:
  void order_by_degree();
  void shape();
  std::size_t reach(std::uint32_t k, const BlockMatrix& matrix);
  int invert(std::uint32_t k, const Block3& diagonal); // −1, 0, 1: the least sign among its pivots

  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<std::uint32_t> order_, inverse_;     // row of the matrix at place k, and the place of each row
  std::vector<std::uint32_t> parent_;              // of the elimination tree
  std::vector<std::size_t> start_;                 // of the columns of L
  std::vector<std::uint32_t> end_;                 // entries of a column so far
  std::vector<std::uint32_t> row_;                 // of each block of L
  std::vector<Block3> lower_;                      // blocks of L below the diagonal, by columns
  std::vector<Block3> pivot_, inverse_pivot_;      // D, D⁻¹
  std::vector<Block3> work_;                       // the row in making, one per column
  std::vector<std::uint32_t> mark_, stack_, path_; // of reach()
  Records solution_;
  double products_ = 0;
  std::size_t total_ = 0;
};

} // namespace rend
