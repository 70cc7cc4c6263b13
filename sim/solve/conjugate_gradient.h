// Conjugate gradients with a preconditioner (Hestenes & Stiefel 1952; Shewchuk 1994, B3), in the unknowns (D +
// Lᵀ) x of preconditioner.h. The residual is measured in the norm |r|² = rᵀ M⁻¹ r, which weighs smooth
// components more than rᵀ r does.
#pragma once

#include "sim/solve/preconditioner.h"
#include "sim/solve/vectors.h"

namespace rend {

class ConjugateGradient {
public:
  struct Result {
    int iterations = 0;
    bool converged = false; // rᵀ M⁻¹ r ≤ tolerance² · bᵀ M⁻¹ b by the recurrence, r = b − A x
  };

  // Solves A x = b for the matrix last given to the preconditioner, from x = 0, with at most `most` iterations
  // on `parts` threads. Stops early, not converged, if the matrix proves not to be positive definite.
  Result solve(Preconditioner& preconditioner, int parts, const Records& b, Records& x, double tolerance,
               int most);

  std::size_t bytes() const { return 6 * residual_.size() * sizeof(Record); }

private:
  // In the order of the preconditioner: r' = (D + L)⁻¹ r, D r', p', (D + Lᵀ)⁻¹ p', (D + L)⁻¹ A of it, x.
  Records residual_, corrected_, direction_, moved_, image_, sum_;
};

} // namespace rend
