// Implicit (backward) Euler (thesis 2.3.1, eq. 2.41): stable at any step, with numerical damping.
//
//   M (v' − v) = h ( f(x', v') + M g − γ v' + loads ),    x' = x + h v'
//
// One stage (stage_scheme.h), solved to 1e-5 of its terms. Order 1. An undamped oscillator loses the factor
// 1/√(1 + ω²h²) a step.
#include "sim/integrate/stage_scheme.h"

namespace rend {
namespace {

class ImplicitEuler final : public StageScheme {
public:
  ImplicitEuler()
      : StageScheme(
            {.digits = 1e-5, .tangent = Tangent::SemiDefinite, .keeps_tangent = 0.1, .secants = false}) {}

private:
  void make_part(const Part& part) override {
    solve({part.system, part.end, part.size, part.size, part.from.position, part.from.velocity});
  }
};

} // namespace

Scheme implicit_euler() {
  return {.name = "implicit",
          .what = "implicit Euler, by Newton's method: stable with every step; damps fast motion",
          .order = 1,
          .evaluations = 2,
          .limit = &no_limit,
          .make = &make_integrator<ImplicitEuler>,
          .solves = true,
          .solves_contact = true,
          .contact = ContactIn::Result};
}

} // namespace rend
