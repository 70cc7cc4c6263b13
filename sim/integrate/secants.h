// Secants of the residual along past updates, which improve a tangent that is kept: the two loops of L-BFGS
// (Nocedal, "Updating quasi-Newton matrices with limited storage", 1980), with the factorised tangent as first
// matrix. 40 steps of slack cloth of 20 × 20 crossed cells take 135 factorisations and 625 updates without
// them, 85 and 505 with them.
//
// Secants along which the potential is not convex are left out, so that the matrix stays positive definite.
#pragma once

#include "sim/solve/vectors.h"

#include <array>

namespace rend {

class Secants {
public:
  void reserve(std::size_t vertices); // slots, so that noting secants asks for no memory
  void forget() { count_ = 0; }       // the tangent is a new one
  bool empty() const { return count_ == 0; }

  // The residual fell from R to R', −gradients of the potential, by the update from v to v'. One record per
  // vertex slot.
  void note(const Records& v, const Records& moved, const Records& residual, const Records& residual_there);

  // Around a solution with the kept tangent: what its right-hand side is instead of R, and what is missing in
  // its solution.
  const Records& right_side(const Records& residual);
  void complete(Records& update);

  std::size_t bytes() const;

private:
  static constexpr std::size_t most = 5;
  struct Secant {
    Records update, change; // v' − v, R − R'
    double product = 0;     // of both, > 0
    double share = 0;       // between right_side() and complete()
  };
  Secant& at(std::size_t age); // 0: the last one

  std::array<Secant, most> secants_; // a ring
  std::size_t count_ = 0, last_ = 0;
  Records right_;
};

} // namespace rend
