// TR-BDF2 (Bank, Coughran, Fichtner, Grosse, Rose and Smith 1985; Hosea and Shampine, "Analysis and
// implementation of TR-BDF2", 1996): the trapezoidal rule over γh, then the second-order backward difference
// over the rest. With γ = 2 − √2, g = γh/2 and the state x₁, v₁ in between,
//
//   x₁ = x + g (v + v₁),               v₁ = v + g (a(x, v) + a(x₁, v₁))
//   x' = c x₁ − (c − 1) x + g v',      v' = c v₁ − (c − 1) v + g a(x', v'),      c = 1/(γ(2 − γ))
//
// so that both stages (stage_scheme.h) have the same p = q = g, and nearly the same matrix. a(x, v) is that of
// the forces that the laws of fracture have looked at: it costs nothing.
//
// Order 2, L-stable: of an oscillator of frequency ω a step leaves the factor R(iωh),
//
//   R(z) = (1 + (1 − γ) z)/(1 − γz/2)²,      |R| ≈ 1 − 0.0037 (ωh)⁴ for small ωh, and 0 for infinite
//
// with a phase error of 0.040 (ωh)³. SDIRK2 with two stages has the same R and the same cost; but its first
// stage is of order 1 only, which shows where forces are stiff and not linear. Both of TR-BDF2 are of order 2.
#include "sim/integrate/stage_scheme.h"

#include <cmath>

namespace rend {
namespace {

class TrBdf2 final : public StageScheme {
public:
  TrBdf2() : StageScheme(second_order_rules) {}
  std::size_t bytes() const override {
    return StageScheme::bytes() + bytes_with({&base_position_, &base_velocity_});
  }

private:
  bool begins_with_forces() const override { return true; }

  void make_part(const Part& part) override {
    const double gamma = 2 - std::sqrt(2.0), g = 0.5 * gamma * part.size;
    const std::size_t count = part.system.vertices();
    base_position_.resize(count);
    base_velocity_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Double4 x = load(part.from.position[i]), v = load(part.from.velocity[i]);
      store(base_position_[i], x + splat(g) * v);
      store(base_velocity_[i], v + splat(g) * load(start_acceleration_[i]));
    }
    solve({part.system, part.start + gamma * part.size, g, g, base_position_.data(), base_velocity_.data()});
    const Double4 ahead = splat(1 / (gamma * (2 - gamma))), back = ahead - splat(1);
    for (std::size_t i = 0; i < count; ++i) {
      store(base_position_[i], ahead * load(position_[i]) - back * load(part.from.position[i]));
      store(base_velocity_[i], ahead * load(velocity_[i]) - back * load(part.from.velocity[i]));
    }
    solve({part.system, part.end, g, g, base_position_.data(), base_velocity_.data()});
  }

  Records base_position_, base_velocity_; // [m], [m/s]: of the stage, one per vertex slot
};

} // namespace

Scheme tr_bdf2() {
  return {.name = "tr-bdf2",
          .what =
              "TR-BDF2, two implicit stages: order 2, stable with every step; what is too fast for the step "
              "goes at once",
          .order = 2,
          .evaluations = 4,
          .limit = &no_limit,
          .make = &make_integrator<TrBdf2>,
          .solves = true};
}

} // namespace rend
