// What makes conjugate gradients short: A ≈ M = (D + L) D⁻¹ (D + Lᵀ), where L is the lower half of A itself and
//
//   D_i = A_ii − ω Σ_j A_ij D_j⁻¹ A_ji   over the j before i
//
// With ω = 0 that is SSOR; with ω = 1 the diagonal blocks of M are those of A (the simplified incomplete factor
// of Meijerink & van der Vorst 1977), which needs fewest iterations while it lasts, and breaks as ν nears 1/2:
// pivots become small, and M far from A. So ω is 1, halved in each row until D_i − 0.6 A_ii is positive.
// Iterations of a step of the organ of 20,000 tetrahedra (h = 10 ms, E = 1e6), by what must be left of A_ii:
//
//   left     0.1    0.25   0.5    0.65   0.8    1 (SSOR)
//   ν 0.3    317    309    276    277    297    373
//   ν 0.45   none   1318   478    459    498    588
//   ν 0.49   none   3822   1010   941    1051   -
//
// Because M shares its halves with A, a product with (D + L)⁻¹ A (D + Lᵀ)⁻¹ needs each half once, and none with
// A (Eisenstat 1981): with t = (D + Lᵀ)⁻¹ p,
//
//   (D + L)⁻¹ A t = t + (D + L)⁻¹ (p + (diag A − 2D) t + C t)
//
// Rows stand in the order of vertex_order.h (a fifth fewer iterations than in gmsh's), and are taken in ranges
// of a fixed length; what couples two ranges, C, is left out of L. Ranges are worked on by several threads, and
// neither the ranges nor the bytes depend on how many. The halves may be stored in single precision, half of
// what an iteration reads: A is then off by 6e-8 of its largest entries, which a solution to one or two digits
// does not see. A step of that organ takes 114 ms where it took 208 with a product and IC(0), and 188 where it
// took 314 (ν 0.3 and 0.45; CPU time of a machine that others used).
#pragma once

#include "sim/rows/block_matrix.h"
#include "sim/solve/vectors.h"

namespace rend {

enum class Precision { Single, Double };

class Preconditioner {
public:
  // False: some diagonal block of the matrix is not positive, and there is nothing to iterate with.
  bool take(const BlockMatrix& matrix, Precision precision);

  // Row of the matrix at each place of the vectors below.
  const std::vector<std::uint32_t>& order() const { return order_; }

  void forward(const Records& r, Records& y) const;            // y = (D + L)⁻¹ r; may be the same
  void product(const Records& p, Records& t, Records& image);  // t, and (D + L)⁻¹ A t
  const std::vector<Block3>& pivots() const { return pivot_; } // D

  std::size_t bytes() const;

  struct Narrow { // a block in single precision
    float column[3][4];
  };
  struct Part {                                       // some of the blocks of A, by rows
    std::vector<std::uint32_t> start, column, source; // place in the matrix of each block
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
  std::vector<std::uint32_t> order_;                // row of the matrix at each place
  Part lower_, upper_, across_;                     // L, Lᵀ, C
  std::vector<Block3> pivot_, inverse_pivot_, gap_; // D, D⁻¹, diag A − 2D, one per row
  Records work_;                                    // of product()
};

} // namespace rend
