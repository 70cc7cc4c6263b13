// The part of external loads in a tangent: moments and forces that turn with the body, pressure, wind.
//
// The matrix A of a scheme knows internal forces alone, and is symmetric. Loads that depend on the state add
// −L, of low rank or small, not symmetric, and not within the pattern of A (a moment joins all vertices of its
// patch):
//
//   (A − L) δ = r,     L δ = share ∂/∂ε load(x + ε by_position δ, v + ε by_velocity δ)
//
// GMRES (Saad & Schultz 1986) solves y − L A⁻¹ y = r, then δ = A⁻¹ y: it needs as many iterations as L has
// rank, and each takes one solution with A and two evaluations of the loads, whose central difference is L δ
// (Knoll & Keyes, "Jacobian-free Newton-Krylov methods", 2004). Loads that do not change along δ cost nothing
// more than to see that.
//
// Where asked (with_forces), L also has what a symmetrised matrix leaves out of the internal forces f: elements
// that turn by one mean rotation are no gradient, the less the stiffer their volume is. Then
//
//   L δ = A δ + ∂/∂ε (f + load)(x + ε δ, v)
#pragma once

#include "sim/integrate/system.h"
#include "sim/solve/linear_solver.h"

namespace rend {

class LoadTangent {
public:
  // How the unknowns move positions and velocities, and what a change of load counts on the right side.
  struct Scales {
    double by_position = 1, by_velocity = 0, share = 1;
  };

  // The state [m], [m/s] and the held axes, one per vertex slot, must stay until it is used no more. `load` of
  // the system is not of that state afterwards.
  void at(System& system, double time, const Records& position, const Records& velocity,
          const std::vector<std::uint8_t>& held, const Scales& scales);

  // Until the next at(): with the internal forces as well, of a matrix that is their tangent by position, to
  // which shift M [1/s²] was added (and stays). Not with a by_velocity or a share.
  void with_forces(const BlockMatrix& matrix, double shift = 0);

  // L δ, 0 at held coordinates; false: it is 0 all over, and not written.
  bool multiply(const Records& along, Records& out);

  // (A − L) δ = r with the matrix that `linear` took: solutions with A to `digits`, and the whole to four at
  // most, as near as 30 iterations come. False: not solved.
  bool solve(LinearSolver& linear, const Records& right, Records& update, double digits);

  std::size_t bytes() const;

  // Whether the last solve() for loads alone found them to matter.
  bool counted() const { return counted_; }

private:
  void move(double epsilon, const Records& along);
  void take(Records& out);
  bool add_direction(LinearSolver& linear, std::size_t n, double digits);
  double rotate(std::size_t n);
  void combine(std::size_t count, Records& update);

  System* system_ = nullptr;
  double time_ = 0;                     // [s]
  int parts_ = 1;                       // threads
  const BlockMatrix* matrix_ = nullptr; // null: loads alone
  double shift_ = 0;                    // [1/s²]
  const Records *position_ = nullptr, *velocity_ = nullptr;
  const std::vector<std::uint8_t>* held_ = nullptr;
  Scales scales_;
  bool counted_ = false;
  double size_ = 0;                     // [m]: of the greatest coordinate
  Records moved_, moved_velocity_;      // [m], [m/s]
  Records force_[2];                    // [N]: at both ends of a difference
  Records image_;                       // L δ
  std::vector<Records> basis_, solved_; // v_n, orthonormal, and A⁻¹ v_n

  // The least squares problem: columns of the Hessenberg matrix as rotations have made them triangular.
  std::vector<std::vector<double>> column_;
  std::vector<double> cosine_, sine_, rest_;
  std::vector<double> share_; // scratch: of each of solved_ in the solution
};

} // namespace rend
