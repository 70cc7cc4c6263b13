// The contribution of external loads to the tangent: follower moments and forces, pressure, wind.
//
// The matrix A of a scheme contains the internal forces only, and is symmetric. Loads that depend on the state
// add −L, which has low rank or is small, is not symmetric, and does not fit the sparsity pattern of A (a
// moment couples all vertices of its patch):
//
//   (A − L) δ = r,     L δ = share ∂/∂ε load(x + ε by_position δ, v + ε by_velocity δ)
//
// GMRES (Saad & Schultz 1986) solves y − L A⁻¹ y = r, then δ = A⁻¹ y: it needs as many iterations as the rank
// of L, and each takes one solution with A and two evaluations of the loads, whose central difference is L δ
// (Knoll & Keyes, "Jacobian-free Newton-Krylov methods", 2004). For loads that do not change along δ the only
// cost is to detect that.
//
// With with_forces(), L also contains the part of the internal forces f that a symmetrised matrix misses:
// forces of elements with one average rotation have no potential, and deviate the more the higher the bulk
// stiffness. Then
//
//   L δ = A δ + ∂/∂ε (f + load)(x + ε δ, v)
#pragma once

#include "sim/integrate/system.h"
#include "sim/solve/linear_solver.h"

namespace rend {

class LoadTangent {
public:
  // How the unknowns change positions and velocities, and the factor of a change of load on the right-hand
  // side.
  struct Scales {
    double by_position = 1, by_velocity = 0, share = 1;
  };

  // Sets the state [m], [m/s] and the constrained axes, one entry per vertex slot, which must outlive the use.
  // Afterwards the system's `load` belongs to another state.
  void at(System& system, double time, const Records& position, const Records& velocity,
          const std::vector<std::uint8_t>& held, const Scales& scales);

  // Until the next at(): includes the internal forces; `matrix` is A + shift M, A their tangent by position and
  // shift [1/s²] (it must outlive the use), and L δ is that of A alone. With the default Scales only: A is not
  // scaled by them. Static solves (static.cpp) and the test of their stability (lowest_eigenvalue.cpp) use it.
  void with_forces(const BlockMatrix& matrix, double shift = 0);

  // L δ, 0 at constrained coordinates; false: it is 0, and not written.
  bool multiply(const Records& along, Records& out);

  // Solves (A − L) δ = r, with A the matrix set in `linear`: systems with A to `digits`, the whole to 1e-4 at
  // best, with up to 30 iterations. False: not solved.
  bool solve(LinearSolver& linear, const Records& right, Records& update, double digits);

  std::size_t bytes() const;

  // Whether the last solve() without with_forces() found the loads to depend on the state.
  bool counted() const { return counted_; }

private:
  void move(double epsilon, const Records& along);
  void evaluate_forces(Records& out);
  bool add_direction(LinearSolver& linear, std::size_t n, double digits);
  double rotate(std::size_t n);
  void combine(std::size_t count, Records& update);

  System* system_ = nullptr;
  double time_ = 0;                     // [s]
  int parts_ = 1;                       // threads
  const BlockMatrix* matrix_ = nullptr; // null: loads only
  double shift_ = 0;                    // [1/s²]
  const Records *position_ = nullptr, *velocity_ = nullptr;
  const std::vector<std::uint8_t>* held_ = nullptr;
  Scales scales_;
  bool counted_ = false;
  double size_ = 0;                     // [m]: the largest coordinate in magnitude
  Records moved_, moved_velocity_;      // [m], [m/s]
  Records force_[2];                    // [N]: at the two ends of a difference
  Records image_;                       // L δ
  std::vector<Records> basis_, solved_; // v_n, orthonormal, and A⁻¹ v_n

  // The least squares problem: columns of the Hessenberg matrix, made triangular by Givens rotations.
  std::vector<std::vector<double>> column_;
  std::vector<double> cosine_, sine_, rest_;
  std::vector<double> share_; // scratch: coefficients of solved_ in the solution
};

} // namespace rend
