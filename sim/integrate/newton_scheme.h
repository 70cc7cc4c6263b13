// What implicit Euler and the static solve share: Newton's method on a matrix over the vertices, the parts that
// loads have in its tangent, and what of both goes from one step to the next.
#pragma once

#include "sim/integrate/integrator.h"
#include "sim/integrate/load_tangent.h"
#include "sim/integrate/state_keeper.h"
#include "sim/solve/vectors.h"

#include <initializer_list>

namespace rend {

class NewtonScheme : public Integrator, public StateKeeper {
public:
  SolverFigures solver() const final {
    return {.newton = newton_,
            .cg = linear_.iterations(),
            .factorisations = linear_.factorisations(),
            .bytes = matrix_.bytes() + linear_.bytes()};
  }
  std::vector<double> saved_state() const final { // `saved_numbers`, and those of the scheme
    std::vector<double> numbers;
    keep_state(numbers);
    return numbers;
  }
  void keep_state(std::vector<double>& numbers) const override;
  bool restore_state(std::span<const double> numbers) override;

protected:
  static constexpr std::size_t saved_numbers = 4;

  // Marks the coordinates that are prescribed at `time` [s] in `axes`, one per vertex slot.
  static void hold(System& system, double time, std::vector<std::uint8_t>& axes);

  // Of arrays of one record per vertex slot, and of the load tangent.
  std::size_t bytes_with(std::initializer_list<const Records*> arrays) const;

  BlockMatrix matrix_;
  LinearSolver linear_;
  LoadTangent load_tangent_;
  long newton_ = 0; // iterations so far
};

} // namespace rend
