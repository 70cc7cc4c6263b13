// A x = b for a symmetric matrix, by the way that takes less work.
//
// The direct way (block_factor.h) takes a number of block products that the pattern alone tells; an iteration
// of conjugate gradients takes about one per block of the matrix. The rule, which knows no clock:
//   direct      where its products are at most 40 per block of the matrix: chains, strips, small sheets
//   iterative   else; and direct where that has spent as much as a factor would have and not converged, and
//               for the next ten matrices
// A factor of more than ten million blocks (1 GB) is never made. Up to two digits are iterated in single
// precision.
#pragma once

#include "sim/solve/block_factor.h"
#include "sim/solve/conjugate_gradient.h"

namespace rend {

class LinearSolver {
public:
  // Takes a matrix, or new values of it; it must stay as it is while it is solved with.
  void take(const BlockMatrix& matrix);

  // To |b − A x| ≤ tolerance · |b|, in the norm of conjugate_gradient.h where it iterates. False: not solved, x
  // is useless.
  bool solve(const Records& b, Records& x, double tolerance);

  // Whether a factor can be made, and how the matrix is then. Where it cannot, Positive is assumed.
  Definiteness factorise();

  // Whether it is going to solve directly; and how the matrix is, as far as solving it has shown.
  bool direct() const;
  Definiteness definiteness() const { return factored_ ? definiteness_ : Definiteness::Positive; }

  // What one solution hands on to the next: the way that is taken, and what is counted (see
  // Integrator::carried).
  static constexpr int most_hard = 10; // matrices in a row that are not worth iterating
  struct Carried {
    int hard = 0; // at most that
    long iterations = 0, factorisations = 0;
  };
  Carried carried() const { return {hard_, iterations_, factorisations_}; }
  void carry(const Carried& from) {
    hard_ = from.hard;
    iterations_ = from.iterations;
    factorisations_ = from.factorisations;
  }

  long iterations() const { return iterations_; }
  long factorisations() const { return factorisations_; }
  std::size_t bytes() const { return factor_.bytes() + preconditioner_.bytes() + gradient_.bytes(); }

private:
  bool factor_fits() const;
  double worth() const; // iterations that a factor takes as long as
  bool iterate(const Records& b, Records& x, double tolerance);

  const BlockMatrix* matrix_ = nullptr;
  BlockFactor factor_;
  Preconditioner preconditioner_;
  ConjugateGradient gradient_;
  bool factored_ = false, preconditioned_ = false; // the matrix as it is
  Precision precision_ = Precision::Double;        // of what is preconditioned
  Definiteness definiteness_ = Definiteness::Positive;
  int hard_ = 0; // matrices to come that are not worth iterating
  long iterations_ = 0, factorisations_ = 0;
};

} // namespace rend
