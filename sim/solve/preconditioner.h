// The preconditioner of conjugate gradients: A ≈ M = (D + L) D⁻¹ (D + Lᵀ), where L is the lower half of A
// itself and
//
//   D_i = A_ii − ω Σ_j A_ij D_j⁻¹ A_ji   over the j before i
//
// ω = 0 gives SSOR; ω = 1 gives M the diagonal blocks of A (the simplified incomplete factorisation of
// Meijerink & van der Vorst 1977), which needs the fewest iterations when it is stable, but breaks down as ν
// approaches 1/2: pivots become small, and M is far from A. So ω starts at 1 and is halved in each row until
// D_i − 0.6 A_ii is positive. Iterations of a step of the organ of 20,000 tetrahedra (h = 10 ms, E = 1e6), by
// the required share of A_ii in D_i:
//
//   share    0.1    0.25   0.5    0.65   0.8    1 (SSOR)
//   ν 0.3    317    309    276    277    297    373
//   ν 0.45   none   1318   478    459    498    588
//   ν 0.49   none   3822   1010   941    1051   -
//
// Because M has the same halves as A, a product with (D + L)⁻¹ A (D + Lᵀ)⁻¹ reads each half once, and needs no
// separate product with A (Eisenstat 1981): with t = (D + Lᵀ)⁻¹ p,
//
//   (D + L)⁻¹ A t = t + (D + L)⁻¹ (p + (diag A − 2D) t + C t)
//
// Rows are in the order of vertex_order.h (a fifth fewer iterations than in gmsh's order), split into ranges of
// fixed length; C, the coupling between ranges, is left out of L. Ranges are processed by several threads, and
// neither the ranges nor the resulting bytes depend on their number. The halves may be stored in single
// precision, which halves the memory traffic of an iteration: A is then perturbed by 6e-8 of its largest
// entries, which does not matter for a tolerance of 1e-2. A step of that organ takes 114 ms instead of 208 with
// a separate product and IC(0), and 188 instead of 314 (ν 0.3 and 0.45; CPU time, on a machine that others
// used).
#pragma once

#include "sim/rows/block_matrix.h"
#include "sim/solve/vectors.h"

namespace rend {

enum class Precision { Single, Double };

class Preconditioner {
public:
  // Factorises a new matrix. False: some diagonal block is not positive definite, and there is no
  // preconditioner.
  bool set_matrix(const BlockMatrix& matrix, Precision precision);

  // Row of the matrix at each position of the vectors below.
  const std::vector<std::uint32_t>& order() const { return order_; }

  void forward(const Records& r, Records& y) const;            // y = (D + L)⁻¹ r; y may be r
  void product(const Records& p, Records& t, Records& image);  // t, and (D + L)⁻¹ A t
  const std::vector<Block3>& pivots() const { return pivot_; } // D

  std::size_t bytes() const;

  struct Narrow { // a block in single precision
    float column[3][4];
  };
  struct Part {                                       // a subset of the blocks of A, by rows
    std::vector<std::uint32_t> start, column, source; // source: index of each block in the matrix
    std::vector<Block3> wide;                         // their values, or
    std::vector<Narrow> narrow;
    void copy(const BlockMatrix& matrix, std::size_t row, Precision precision);
    std::size_t bytes() const;
  };

private:
  void shape();
  bool choose_pivot(std::size_t i, const Block3& own, const Block3& sum);
  bool factorise(const BlockMatrix& matrix, std::size_t begin, std::size_t end);
  void forward(std::size_t begin, std::size_t end, const Record* r, Record* y) const;
  void backward(std::size_t begin, std::size_t end, const Record* p, Record* t, Record* rest) const;
  void finish(std::size_t begin, std::size_t end, const Record* t, Record* y, Record* image) const;

  std::shared_ptr<const BlockPattern> pattern_;
  Precision precision_ = Precision::Double;
  std::vector<std::uint32_t> order_;                // row of the matrix at each position
  Part lower_, upper_, coupling_;                   // L, Lᵀ, C
  std::vector<Block3> pivot_, inverse_pivot_, gap_; // D, D⁻¹, diag A − 2D, one per row
  Records work_;                                    // of product()
};

} // namespace rend
