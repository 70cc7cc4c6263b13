// Solves A x = b for a symmetric matrix, directly or iteratively, whichever takes less work.
//
// The number of block products of the direct solver (block_factor.h) follows from the pattern alone; an
// iteration of conjugate gradients takes about one per block of the matrix. The rule, which does not depend on
// measured times:
//   direct      if its products are at most 40 per block of the matrix: chains, strips, small sheets
//   iterative   otherwise; but if it has cost as much as a factorisation without converging, the direct solver
//               takes over, and solves the next ten matrices too
// A factor of more than ten million blocks (1 GB) is never made. With a tolerance of 1e-2 or more the
// preconditioner is in single precision.
#pragma once

#include "sim/solve/block_factor.h"
#include "sim/solve/conjugate_gradient.h"

namespace rend {

class LinearSolver {
public:
  // Sets the matrix, or new values of it; it must not change while it is in use.
  void set_matrix(const BlockMatrix& matrix);

  // Solves to |b − A x| ≤ tolerance · |b|, if iterative in the norm of conjugate_gradient.h. False: not solved,
  // x is unusable.
  bool solve(const Records& b, Records& x, double tolerance);

  // Factorises if the factor is not too large, and returns the definiteness; Positive is assumed otherwise.
  Definiteness factorise();

  // Whether the next solution will be direct; and the definiteness of the matrix, as far as it is known.
  bool direct() const;
  Definiteness definiteness() const { return factored_ ? definiteness_ : Definiteness::Positive; }

  // The state that one solution passes on to the next: which solver is used, and counters (see
  // Integrator::saved_state).
  static constexpr int direct_streak = 10; // matrices in a row solved directly after an iteration failed
  struct SavedState {
    int hard = 0; // at most direct_streak
    long iterations = 0, factorisations = 0;
  };
  SavedState saved_state() const { return {direct_left_, iterations_, factorisations_}; }
  void restore_state(const SavedState& from) {
    direct_left_ = from.hard;
    iterations_ = from.iterations;
    factorisations_ = from.factorisations;
  }

  long iterations() const { return iterations_; }
  long factorisations() const { return factorisations_; }
  std::size_t bytes() const { return factor_.bytes() + preconditioner_.bytes() + gradient_.bytes(); }

private:
  bool factor_fits() const;
  double factorisation_cost() const; // the cost of a factorisation in iterations
  bool iterate(const Records& b, Records& x, double tolerance);

  const BlockMatrix* matrix_ = nullptr;
  BlockFactor factor_;
  Preconditioner preconditioner_;
  ConjugateGradient gradient_;
  // is the factor, or the preconditioner, that of the current matrix?
  bool factored_ = false, preconditioned_ = false;
  Precision precision_ = Precision::Double; // of the preconditioner
  Definiteness definiteness_ = Definiteness::Positive;
  int direct_left_ = 0; // number of matrices that will still be solved directly
  long iterations_ = 0, factorisations_ = 0;
};

} // namespace rend
