// The fastest motion of a body: the largest eigenvalue of K φ = ω² M φ, M the lumped masses.
//
// Lanczos (1950) on M^(−1/2) K M^(−1/2) over the free coordinates, with every vector made orthogonal to all
// before it (twice: Parlett, "The Symmetric Eigenvalue Problem", 13): without that the largest value is found
// again and again. It stops where the residual |A y − θ y| is at most `tolerance` θ; some eigenvalue is that
// near to θ, and the error of θ is of the order of its square. The start is fixed, and no coordinate of it is
// 0: the same figures in each run. `rend check` holds this against the bound of program/frequency.h, which
// needs no matrix.
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

// `stiffness` [N/m] is symmetric; inverse_mass [1/kg], 0: free slot; `held`: axes as System::hold, one per
// vertex slot (rows and columns of held coordinates count as absent, whatever they hold). At most `most`
// iterations.
HighestMode highest_mode(const BlockMatrix& stiffness, const double* inverse_mass,
                         const std::vector<std::uint8_t>& held, double tolerance = 1e-6, int most = 300);

// Numbers in [−1, 1) that are the same on every machine, of the coordinates with mass that are not held; 0
// elsewhere.
Records scattered(std::size_t count, const double* inverse_mass, const std::vector<std::uint8_t>& held,
                  std::uint64_t seed);

} // namespace rend
