// Explicit Euler, thesis 2.36:   v' = v + dt a(x, v),   x' = x + dt v
//
// Order 1. Without damping it gains energy at any step; with it, stable up to 2ξ/ω.
#include "sim/integrate/integrator.h"

namespace rend {
namespace {

REND_INLINE void move(const System& system, std::size_t count, double step, const StateView& now,
                      const Record* force, State& next) {
  const Double4 h = splat(step);
  for (std::size_t i = 0; i < count; ++i) {
    const Double4 v = load(now.velocity[i]);
    next.put(i, load(now.position[i]) + h * v, v + h * system.acceleration(i, load(force[i]), v));
  }
}

class ExplicitEuler final : public Integrator {
  void advance(System& system, double time, double step, const StateView& now, const Record* force,
               State& next) override {
    at_width<move>(system, system.vertices(), step, now, force, next);
    system.constrain(time + step, next.position.data(), next.velocity.data());
  }
};

} // namespace

Scheme explicit_euler() {
  return {
      "explicit",
      "explicit Euler: stable through damping alone",
      1,
      1,
      &limit_by_drag,
      [](const SchemeSettings&) -> std::unique_ptr<Integrator> { return std::make_unique<ExplicitEuler>(); }};
}

} // namespace rend
