// Conjugate gradients with a preconditioner (Hestenes & Stiefel 1952; Shewchuk 1994, B3).
#pragma once

#include "sim/solve/preconditioner.h"
#include "sim/solve/vectors.h"

namespace rend {

class ConjugateGradient {
public:
  struct Result {
    int iterations = 0;
    bool converged = false; // |b − A x| ≤ tolerance · |b| by the recurrence
  };

  // From x = 0, at most `most` iterations. It stops before, not converged, where the matrix proves not to be
  // positive.
  Result solve(const BlockMatrix& matrix, const Preconditioner& preconditioner, const Records& b, Records& x,
               double tolerance, int most);

  std::size_t bytes() const { return 4 * residual_.size() * sizeof(Record); }

private:
  Records residual_, direction_, image_, corrected_; // r, p, A p, M⁻¹ r
};

} // namespace rend
