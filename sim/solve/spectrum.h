// The highest mode of a body: the largest eigenvalue of K φ = ω² M φ, with M the lumped mass matrix.
//
// Lanczos (1950) on M^(−1/2) K M^(−1/2) over the free coordinates, with full reorthogonalisation (twice:
// Parlett, "The Symmetric Eigenvalue Problem", 13): without it the largest eigenvalue is found repeatedly. It
// stops when the residual |A y − θ y| is at most `tolerance` θ; some eigenvalue is that close to θ, and the
// error of θ is of the order of its square. The start vector is fixed, and none of its coordinates is 0:
// results are reproducible. `rend check` compares this with the bound of rows/frequency.h, which needs no
// matrix.
#pragma once

#include "sim/rows/block_matrix.h"
#include "sim/solve/vectors.h"

namespace rend {

struct HighestMode {
  double omega_squared = 0; // [1/s²]
  double residual = 0;      // |A y − θ y|/θ
  Records shape;            // φ, of unit mass: Σ m φ² = 1; one per vertex slot
  int iterations = 0;
};

// `stiffness` [N/m] is symmetric; inverse_mass [1/kg], 0: free slot; `held`: constrained axes as in
// System::hold, one entry per vertex slot (rows and columns of constrained coordinates count as absent,
// whatever they contain). At most `most` iterations.
HighestMode highest_mode(const BlockMatrix& stiffness, const double* inverse_mass,
                         const std::vector<std::uint8_t>& held, double tolerance = 1e-6, int most = 300);

// Pseudo-random numbers in [−1, 1), the same on every machine, for the unconstrained coordinates with mass; 0
// elsewhere.
Records scattered(std::size_t count, const double* inverse_mass, const std::vector<std::uint8_t>& held,
                  std::uint64_t seed);

} // namespace rend
